"""The section on tile size."""
import report  # noqa: F401, where tessera_report lies
from tessera_report import rows
from quantities import factor, least, most, share
from scenes import common, counter, find, scene_of, stages, sweep_of, time_of, values_of, winner


def values(sweep):
  tiles, binnings = sweep.order("tile"), sweep.order("binning")
  scenes = []
  over = {}  # binning, tile -> its time over the fastest cell's, a scene each
  winners = []
  spreads = []  # the worst tile's time over the best one's, a scene and way of binning each
  for group in sweep.groups:
    best, fastest = winner(group, group.candidates, ["binning", "tile"])
    winners.append(fastest)
    for binning in binnings:
      cells = [cell for cell in group.candidates if cell.values["binning"] == binning]
      if cells:
        best_, worst = (pick(cells, key=lambda cell: cell.ratio.median) for pick in (min, max))
        spreads.append(spread(group, worst, best_))
    for cell in group.candidates:
      over.setdefault((cell.values["binning"], cell.values["tile"]), []).append(group.compare(cell, fastest[0]).median)
    exact = [find(group, binning="exact", tile=tile) for tile in tiles]
    scenes.append({
        **scene_of(group), "best": best,
        "ratios": [[time_of(find(group, binning=binning, tile=tile), fastest) for tile in tiles] for binning in binnings],
        "pairs": [factor(counter(cell, "binned") / counter(cell, "pieces")) if cell and cell.timed else None for cell in exact],
        "binning": [share(bin_time(cell), sum(stages(cell).values())) if cell and cell.timed else None for cell in exact],
    })
  whole = {key: max(values) for key, values in over.items() if len(values) == len(sweep.groups)}
  if not whole:
    raise rows.Refused(f"{sweep.folder}/rows.jsonl: no cell has a time on every scene; run the sweep again")
  safest = min(whole, key=whole.get)
  spreads = [factor_ for factor_ in spreads if factor_]
  return {
      **sweep_of(sweep, "tile-size"), "tiles": tiles, "binnings": binnings, "places": scenes,
      # Among the fastest, that is the fastest or equal to it, on every scene.
      "commonTiles": common([values_of(cells_, "tile", tiles) for cells_ in winners], tiles),
      "commonBinnings": common([values_of(cells_, "binning", binnings) for cells_ in winners], binnings),
      "safest": {"name": f"binning={safest[0]} tile={safest[1]}", "worst": factor(whole[safest])},
      "leastSpread": least(spreads), "mostSpread": most(spreads),
  }


def spread(group, slower, faster):
  """None where the two are equal."""
  ratio = group.compare(slower, faster)
  return None if ratio.equal else factor(ratio.median)


def bin_time(cell):
  return sum(ns for stage, ns in stages(cell).items() if stage.startswith(("bin-", "scan-")))
