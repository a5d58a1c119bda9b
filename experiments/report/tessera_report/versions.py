"""Rows of earlier schema versions, as those of the newest one."""

OLDEST = 2  # that is still read


def held(row):
  """What the row's image holds beside coverage: fields of `error`. Version 2 had a 0 for what there was not."""
  commit = row["variant"].get("commit")
  if commit == "count":
    found = {"hit_count_mismatch"}
  elif commit in ("depth24+lum8", "depth32+rgba8"):
    found = {"depth_mismatch", "depth_max_ulp", "depth_max_abs"}
  else:
    found = {"id_mismatch", "depth_mismatch", "depth_max_ulp", "depth_max_abs"}
  return found | ({"attribute_mismatch"} if "attribute" in row["scene"] else set())


COUNTED = ("id_mismatch", "depth_mismatch", "hit_count_mismatch", "attribute_mismatch", "depth_max_ulp", "depth_max_abs")


def raised(row):
  """The row in the newest version."""
  if row["schema_version"] > OLDEST or not ({"error", "truth_error"} & row.keys()):
    return row
  if row.get("error", {}).get("id_mismatch") is not None and "id_mismatch" in held(row):
    row["error"] = {**row["error"], "winner_mismatch": row["error"]["id_mismatch"]}
  absent = [name for name in COUNTED if name not in held(row)]
  for part in ("error", "truth_error", "error_samples"):
    if part in row:
      row[part] = {**row[part], **{name: None for name in absent if name in row[part] and part != "error_samples"}}
  if "error_samples" in row:
    row["error_samples"] = {name: values for name, values in row["error_samples"].items() if name not in absent}
  return row
