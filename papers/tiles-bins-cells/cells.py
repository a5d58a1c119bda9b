"""The section on cells."""
import report  # noqa: F401, where tessera_report lies
from tessera_report import words
import crossovers
from quantities import area, factor, least, most, quantity, rounded, share
from scenes import counter, find, scene_of, stages, sweep_of, time_of, values_of, winner

REFERENCE = {"traversal": "cell-reject", "step": "direct", "size-class": "off"}


def values(sweep):
  axes = ["traversal", "step", "size-class"]
  traversals = sweep.order("traversal")
  groups = sorted(sweep.groups, key=lambda group: float(group.cells[0].values["x"]))
  areas, winners = [], []
  for group in groups:
    best, fastest = winner(group, group.candidates, axes)
    winners.append(values_of(fastest, "traversal", traversals))
    areas.append({
        **scene_of(group), "area": area(float(group.cells[0].values["x"])), "best": best, "equals": quantity(len(fastest) - 1),
        "ratios": [time_of(find(group, **{**REFERENCE, "traversal": traversal}), fastest) for traversal in traversals],
        "tests": [per_covered(find(group, **{**REFERENCE, "traversal": traversal})) for traversal in traversals],
    })
  pairs = crossovers.pairs(groups, traversals, find)
  for pair in pairs:
    for crossing in pair["crossings"]:
      crossing |= {"at": rounded(crossing["at"], "pixels"), "low": area(crossing["low"]), "high": area(crossing["high"])}
  gains = [{"area": line["area"], "name": line["best"]["name"], **line["best"]["ratio"]} for line in areas if line["best"]["ratio"]["verdict"] == "faster"]
  by_pixel = [line["tests"][traversals.index("pixel")] for line in areas]
  by_cell = [line["tests"][traversals.index("cell-reject")] for line in areas]
  return {
      **sweep_of(sweep, "pineda-cells"), "traversals": traversals, "areas": areas, "pairs": pairs,
      "variants": quantity(len({words.cell_name(cell, axes) for cell in sweep.cells})),
      "crossing": quantity(sum(bool(pair["crossings"]) for pair in pairs)),
      "mostGain": least(gains), "gains": quantity(len(gains)),
      "winners": [{"traversals": traversals_, "from": areas[first]["area"], "to": areas[last]["area"]} for traversals_, first, last in crossovers.runs(winners)],
      "front": [share(sum(ns for stage, ns in stages(group.reference).items() if stage in ("transform", "project", "setup")),
                      sum(stages(group.reference).values())) for group in groups],
      "smallest": areas[0]["area"], "largest": areas[-1]["area"],
      "pixelTests": [most([t for t in by_pixel if t]), least([t for t in by_pixel if t])],
      "cellTests": [most([t for t in by_cell if t]), least([t for t in by_cell if t])],
  }


def per_covered(cell):
  return factor(counter(cell, "tests") / counter(cell, "covered")) if cell and cell.status == "ok" and counter(cell, "covered") else None
