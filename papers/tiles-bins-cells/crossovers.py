"""At which area of a triangle one cell becomes faster than another."""
import math


def crossings(points):
  """`points` are (area, ratio, equal), by area: the time of one cell over another's, and whether noise alone gives such a ratio.

  A crossing lies between two decided points of opposite verdicts that have only equal ones between them: (where, from, to, whether
  the ratio falls below 1). `where` is the first place from there on where the ratio is 1, straight between points in
  logarithms of both; from and to are the decided points' areas."""
  found = []
  decided = [index for index, (_, _, equal) in enumerate(points) if not equal]
  for a, b in zip(decided, decided[1:]):
    below = points[b][1] < 1
    if (points[a][1] < 1) == below:
      continue
    for i in range(a, b):
      (x, r, _), (y, s, _) = points[i], points[i + 1]
      if (r < 1) != (s < 1):
        along = math.log(r) / (math.log(r) - math.log(s))
        found.append((math.exp(math.log(x) + along * (math.log(y) - math.log(x))), points[a][0], points[b][0], below))
        break
  return found


def compared(groups, name, other, one, two):
  """Two cells over the areas; `one` and `two` find them in a group."""
  points, curve = [], []
  for group in groups:
    a, b = one(group), two(group)
    ratio = group.compare(a, b) if a and b else None
    if ratio:
      points.append((float(group.cells[0].values["x"]), ratio.median, ratio.equal))
      curve.append({"area": points[-1][0], "ratio": ratio.median, "low": ratio.low, "high": ratio.high})
  verdicts = ["equal" if equal else "faster" if ratio < 1 else "slower" for _, ratio, equal in points]
  return {"name": name, "other": other, **{verdict: verdicts.count(verdict) for verdict in ("faster", "equal", "slower")},
          "curve": curve,
          "crossings": [{"at": at, "low": low, "high": high, "faster": below} for at, low, high, below in crossings(points)]}


def pairs(groups, traversals, find):
  """Each two traversals, else as the reference; and for each traversal either step and either size class."""
  found = []
  plain = {"step": "direct", "size_class": "off"}
  for index, traversal in enumerate(traversals):
    for other in traversals[:index]:
      found.append({"kind": "traversal"} | compared(groups, traversal, other, lambda g: find(g, traversal=traversal, **plain),
                                                    lambda g: find(g, traversal=other, **plain)))
  for axis, value, usual in (("step", "incremental", "direct"), ("size_class", "on", "off")):
    for traversal in traversals:
      found.append({"kind": axis.replace("_", "-"), "traversal": traversal} | compared(
          groups, f"{axis.replace('_', '-')}={value}", f"{axis.replace('_', '-')}={usual}",
          lambda g: find(g, traversal=traversal, **plain | {axis: value}), lambda g: find(g, traversal=traversal, **plain)))
  return found


def runs(winners):
  """`winners` are the traversals that are the fastest or equal to it, an area each. What wins where, in as few stretches as will do:
  (those that are among the fastest all along, first index, last index)."""
  found = []
  for index, names in enumerate(winners):
    both = [name for name in found[-1][0] if name in names] if found else []
    if both:
      found[-1] = (both, found[-1][1], index)
    else:
      found.append((names, index, index))
  return found
