"""A plot's panels as Vega-Lite, for the page: drawn in the browser, as wide as the page is."""

import math

import altair as alt

from . import panels, scales

HEIGHT = 220
INK, FAINT = "#222222", "#8a8a8a"
CONFIG = {
  "font": "system-ui, sans-serif",
  "background": None,
  "view": {"stroke": "#cccccc"},
  "axis": {
    "labelColor": INK,
    "titleColor": INK,
    "titleFontWeight": "normal",
    "labelFontSize": 11,
    "titleFontSize": 12,
    "gridColor": "#ececec",
    "domainColor": "#999999",
    "tickColor": "#999999",
    "labelLimit": 240,
  },
  "legend": {"labelColor": INK, "titleColor": INK, "titleFontWeight": "normal"},
}


def labels(values, texts):
  """An axis' labels by lookup, since they are the same on paper."""
  pairs = [[value, text] for value, text in zip(values, texts)]
  # Ticks pass through floating point: the nearest one's text is the label.
  return (
    "".join(f"abs(datum.value/{value!r}-1)<1e-6?'{text}':" for value, text in pairs if value)
    + "".join(f"datum.value==0?'{text}':" for value, text in pairs if not value)
    + "''"
  )


def data(rows):
  return alt.InlineData(values=rows)


def axis(kind, title, field, span, ticks, texts, logarithmic):
  return kind(
    f"{field}:Q",
    title=title or None,
    scale=alt.Scale(domain=list(span), nice=False, **({"type": "log"} if logarithmic else {"zero": False})),
    axis=alt.Axis(values=ticks, labelExpr=labels(ticks, texts), grid=True, labelOverlap=True),
  )


def words(kind, title, field, order):
  return kind(
    f"{field}:N",
    title=title or None,
    sort=order,
    scale=alt.Scale(domain=order),
    axis=alt.Axis(labelAngle=-30 if kind is alt.X and sum(map(len, order)) > 32 else 0, grid=False),
  )


def curve_scales(curves):
  styles = [panels.style(curves, curve) for curve in curves]
  return (
    alt.Color("curve:N", legend=None, scale=alt.Scale(domain=curves, range=[colour for colour, _ in styles])),
    alt.Shape("curve:N", legend=None, scale=alt.Scale(domain=curves, range=[shape for _, shape in styles])),
  )


def break_of(plot, spans):
  """The strip for errors of 0, and the break above it."""
  return [
    alt.Chart(data([{"low": spans["y"][0], "high": plot.zero * panels.BREAK}]))
    .mark_rect(color="#f3f1ea")
    .encode(y=alt.Y("low:Q"), y2="high"),
    alt.Chart(data([{"y": plot.zero * panels.BREAK}]))
    .mark_rule(color=FAINT, strokeDash=[2, 3])
    .encode(y=alt.Y("y:Q")),
  ]


def joined(panel, x, y, colour):
  """The panel's lines, the faint ones first."""
  layers = []
  for strong in (False, True):
    found = [
      {"x": px, "y": py, "curve": curve, "line": index, "order": order}
      for index, (curve, best, points) in enumerate(panel.lines)
      if best == strong
      for order, (px, py) in enumerate(points)
    ]
    if found:
      layers.append(
        alt.Chart(data(found))
        .mark_line(strokeWidth=2 if strong else 0.8, opacity=1 if strong else 0.4)
        .encode(x=x, y=y, color=colour, detail="line:N", order="order:Q")
      )
  return layers


def points_of(panel):
  return [{"x": p.x, "y": p.y, "low": p.low, "high": p.high, "curve": p.curve, "says": p.says} for p in panel.points]


def behind(plot, panel, spans, **along):
  """What lies behind all marks: the strip of errors of 0, and the A/A band along the axis of times."""
  layers = break_of(plot, spans) if plot.zero else []
  if panel.band:
    band = alt.Chart(data([{"low": panel.band[0], "high": panel.band[1]}]))
    layers.append(band.mark_rect(color="#bbbbbb", opacity=0.45).encode(**along))
  return layers


def precision(plot, panel, spans):
  colour, shape = curve_scales(plot.curves)
  rows = points_of(panel)
  ticks_x = scales.ticks(*spans["x"], True)
  x = axis(alt.X, plot.x, "x", spans["x"], ticks_x, [scales.text(tick) for tick in ticks_x], True)
  if plot.kind == "strip":
    y = words(alt.Y, None, "y", plot.rows)
  else:
    y = axis(alt.Y, plot.y, "y", spans["y"], *panels.error_ticks(spans["y"], plot.zero), True)
  layers = behind(plot, panel, spans, x=alt.X("low:Q"), x2="high")
  layers += joined(panel, x, y, colour)
  if len(panel.front) > 1:
    layers.append(
      alt.Chart(data([{"x": fx, "y": fy} for fx, fy in panel.front]))
      .mark_line(interpolate="step-after", color=FAINT, strokeWidth=1.2)
      .encode(x=x, y=y, order="x:Q")
    )
  layers.append(alt.Chart(data(rows)).mark_rule(opacity=0.6).encode(x=alt.X("low:Q"), x2="high", y=y, color=colour))
  layers.append(
    alt.Chart(data(rows))
    .mark_point(filled=True, size=64, opacity=0.9)
    .encode(x=x, y=y, color=colour, shape=shape, tooltip=alt.Tooltip("says:N", title=" "))
  )
  return alt.layer(*layers).properties(height=HEIGHT if plot.kind == "precision" else 26 * len(plot.rows))


def lines(plot, panel, spans):
  colour, shape = curve_scales(plot.curves)
  is_words = isinstance(plot.ticks[0], str)
  rows = points_of(panel)
  if is_words:
    x = words(alt.X, plot.x, "x", plot.ticks)
  else:
    x = axis(alt.X, plot.x, "x", spans["x"], plot.ticks, plot.labels, plot.x_log)
  y = axis(alt.Y, plot.y, "y", spans["y"], *panels.error_ticks(spans["y"], plot.zero), True)
  offset = {"xOffset": alt.XOffset("curve:N", scale=alt.Scale(domain=plot.curves))} if is_words else {}
  layers = behind(plot, panel, spans, y=alt.Y("low:Q"), y2="high")
  if panel.bands:
    bands = alt.Chart(data([{"x": bx, "low": low, "high": high} for bx, low, high in panel.bands]))
    bands = (
      bands.mark_rect(color="#bbbbbb", opacity=0.45)
      if is_words
      else bands.mark_rule(color="#bbbbbb", opacity=0.45, strokeWidth=14)
    )
    layers.append(bands.encode(x=x, y=alt.Y("low:Q"), y2="high"))
  layers += joined(panel, x, y, colour)
  if panel.levels:
    layers.append(
      alt.Chart(data([{"y": ly, "curve": curve, "says": says} for curve, ly, says in panel.levels]))
      .mark_rule(strokeDash=[5, 3], strokeWidth=1.6)
      .encode(y=y, color=colour, tooltip=alt.Tooltip("says:N", title=" "))
    )
  layers.append(
    alt.Chart(data(rows)).mark_rule(opacity=0.6).encode(x=x, y=alt.Y("low:Q"), y2="high", color=colour, **offset)
  )
  layers.append(
    alt.Chart(data(rows))
    .mark_point(filled=True, size=48, opacity=0.9)
    .encode(x=x, y=y, color=colour, shape=shape, tooltip=alt.Tooltip("says:N", title=" "), **offset)
  )
  if panel.failed:
    layers.append(
      alt.Chart(data([{"x": fx, "says": says} for fx, says in panel.failed]))
      .mark_point(shape="M-1,-1L1,1M-1,1L1,-1", size=30, color=INK, strokeWidth=1.5, filled=False)
      .encode(x=x, y=alt.value(HEIGHT - 7), tooltip=alt.Tooltip("says:N", title=" "))
    )
  return alt.layer(*layers).properties(height=HEIGHT)


def heat(plot, panel, spans):
  low, high = spans["value"]
  middle = math.sqrt(low * high)
  rows = [{"x": hx, "y": hy, "value": value, "text": text, "says": says} for hx, hy, value, text, says in panel.cells]
  x, y = words(alt.X, plot.x, "x", plot.ticks), words(alt.Y, plot.y, "y", plot.rows)
  known = (
    alt.Chart(data([row for row in rows if row["value"] is not None]))
    .mark_rect(stroke="white")
    .encode(
      x=x,
      y=y,
      tooltip=alt.Tooltip("says:N", title=" "),
      color=alt.Color(
        "value:Q", legend=None, scale=alt.Scale(type="log", scheme="cividis", reverse=True, domain=[low, high])
      ),
    )
  )
  layers = [known]
  if any(row["value"] is None for row in rows):
    layers.append(
      alt.Chart(data([row for row in rows if row["value"] is None]))
      .mark_rect(stroke="white", fill="#eeeeee")
      .encode(x=x, y=y, tooltip=alt.Tooltip("says:N", title=" "))
    )
  layers.append(
    alt.Chart(data([{**row, "ink": "#ffffff" if (row["value"] or 0) > middle else INK} for row in rows]))
    .mark_text(fontSize=11)
    .encode(x=x, y=y, text="text:N", color=alt.Color("ink:N", scale=None))
  )
  return alt.layer(*layers).resolve_scale(color="independent").properties(height=34 * len(plot.rows))


def bars(plot, panel, spans):
  order = list(dict.fromkeys(bar for bar, _, _, _ in panel.cells))
  rows = [
    {"bar": bar, "stage": stage, "order": plot.rows.index(stage), "ms": ms, "says": says}
    for bar, stage, ms, says in panel.cells
  ]
  colours = [colour for _, colour in panels.stage_colours(plot)]
  return (
    alt.Chart(data(rows))
    .mark_bar(stroke="white", strokeWidth=0.5)
    .encode(
      y=alt.Y("bar:N", title=None, sort=order, axis=alt.Axis(labelFontSize=10, grid=False)),
      x=alt.X("ms:Q", title=plot.x, stack="zero", axis=alt.Axis(tickCount=6)),
      color=alt.Color("stage:N", legend=None, scale=alt.Scale(domain=plot.rows, range=colours)),
      order="order:Q",
      tooltip=alt.Tooltip("says:N", title=" "),
    )
    .properties(height=15 * len(order))
  )


def spec(plot, panel):
  """The panel's Vega-Lite as a dictionary, with the words that a screen reader gets."""
  make = {"precision": precision, "strip": precision, "lines": lines, "heat": heat, "bars": bars}[plot.kind]
  chart = make(plot, panel, panels.spans_of(plot, panel))
  number = len(panel.points) or len(panel.cells)
  about = (
    f"{plot.title}{': ' + panel.title if panel.title else ''}. {number} marks; the table of all rows has the numbers."
  )
  chart = chart.properties(
    width="container", description=about, autosize=alt.AutoSizeParams(type="fit-x", contains="padding")
  )
  found = chart.to_dict()
  found.pop("config", None), found.pop("$schema", None)
  return found
