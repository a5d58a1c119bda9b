"""The section on bins and their capacity."""
import report  # noqa: F401, where tessera_report lies
from tessera_report import ratios
from quantities import factor, least, most, quantity, share
from scenes import counter, find, scene_of, sweep_of, time_of, winner


def lost(cell):
  """Pixels with another triangle under overflow=drop: median, least and most over the runs, as shares of the raster."""
  samples = cell.row.get("error_samples", {}).get("id_mismatch") or [cell.row["error"]["id_mismatch"]]
  pixels = cell.row["error"]["pixels"]
  middle = ratios.spread(samples)[0]
  return {**share(middle, pixels), "least": share(min(samples), pixels), "most": share(max(samples), pixels), "none": max(samples) == 0}


def values(sweep):
  capacities = sweep.order("capacity")
  scenes = []
  retries, prices = 0, []  # queues that ran again; what they cost over one that was large enough, where noise does not
  for group in sweep.groups:
    exact, bitmask = find(group, binning="exact"), find(group, binning="bitmask")
    queues = {policy: [find(group, binning="queue", capacity=capacity, overflow=policy) for capacity in capacities] for policy in ("retry", "drop")}
    lines = []
    for capacity, retry, drop in zip(capacities, queues["retry"], queues["drop"]):
      dropped = drop and drop.timed
      entries = counter(drop, "overflowed") + counter(drop, "binned") if dropped else 0
      lines.append({
          "capacity": quantity(int(capacity)), "retry": time_of(retry), "drop": time_of(drop),
          "retries": quantity(counter(retry, "retries")) if retry and retry.timed else None,
          "dropped": share(counter(drop, "overflowed"), entries) if dropped else None,
          "wrong": lost(drop) if dropped else None,
      })
    enough = next((cell for cell in queues["retry"] if cell and cell.timed and counter(cell, "retries") == 0), None)
    lossless = next((line["capacity"] for line in lines if line["wrong"] and line["wrong"]["none"]), None)
    retried = [cell for cell in queues["retry"] if cell and cell.timed and counter(cell, "retries") > 0]
    price = [group.compare(cell, enough) for cell in retried] if enough else []
    retries += len(price)
    prices += [factor(ratio.median) for ratio in price if ratio.verdict == "slower"]
    quickest, _ = winner(group, [cell for cell in [*queues["retry"], exact, bitmask] if cell and cell.timed], ["binning", "capacity", "overflow"])
    scenes.append({
        **scene_of(group), "lines": lines, "bitmask": time_of(bitmask), "best": quickest,
        "fullest": quantity(counter(exact, "largestBin")),
        "enough": quantity(int(enough.values["capacity"])) if enough else None, "lossless": lossless,
    })
  lossy = [{**line, "scene": scene["name"]} for scene in scenes for line in scene["lines"] if line["wrong"] and not line["wrong"]["none"]]
  gains = [line for line in lossy if line["drop"]["verdict"] == "faster"]
  bitmasks = [scene["bitmask"] for scene in scenes if "value" in scene["bitmask"]]
  varies = any(line["wrong"]["least"]["value"] != line["wrong"]["most"]["value"] for line in lossy)
  return {
      **sweep_of(sweep, "bin-capacity"), "capacities": [quantity(int(capacity)) for capacity in capacities], "places": scenes,
      "tile": sweep.cells[0].row["variant"]["tile"],
      "leastPrice": least(prices), "mostPrice": most(prices), "retried": quantity(retries), "dear": quantity(len(prices)),
      # Where dropping pays, if anywhere: the faster lossy cells, and the least that such a cell loses.
      "gains": quantity(len(gains)), "lossy": quantity(len(lossy)),
      "cheapest": min(gains, key=lambda line: line["wrong"]["value"], default=None),
      "worst": max(lossy, key=lambda line: line["wrong"]["value"], default=None),
      "varies": varies, "bitmask": [least(bitmasks), most(bitmasks)],
  }
