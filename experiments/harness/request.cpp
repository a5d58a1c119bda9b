#include "experiments/harness/request.h"

#include "experiments/harness/fields.h"

namespace tessera::harness {
namespace {

Variant variantOf(const Json& json) {
  Variant variant;
  for (const auto& [axis, value] : json.items()) variant.set(axis, textAt(json, axis.c_str()));
  return variant;
}

const Json& pairAt(const Json& json, const char* key) {
  const Json& pair = listAt(json, key);
  if (pair.size() != 2 || !pair[0].is_number() || !pair[1].is_number()) failField(key, &pair, "two numbers");
  return pair;
}

Json cellJson(const WorkerPoint& cell) {
  Json json{{"number", cell.number},
            {"size", {cell.size.width, cell.size.height}},
            {"threads", cell.threads},
            {"asked", cell.asked.values()},
            {"kernels", Json::object()}};
  for (const auto& [stage, file] : cell.kernels) json["kernels"][stage] = file.string();
  return json;
}

WorkerPoint cellOf(const Json& json) {
  WorkerPoint cell{.number = wholeAt<std::uint32_t>(json, "number"),
                   .size = {pairAt(json, "size")[0], pairAt(json, "size")[1]},
                   .threads = wholeAt<unsigned>(json, "threads"),
                   .asked = variantOf(objectAt(json, "asked")),
                   .kernels = {}};
  for (const auto& [stage, file] : objectAt(json, "kernels").items())
    cell.kernels[stage] = textAt(objectAt(json, "kernels"), stage.c_str());
  return cell;
}

}  // namespace

Json toJson(const WorkerJob& job) {
  Json json{{"input", job.input},    {"attribute", job.attribute.name},
            {"device", job.device},  {"truth", job.truth.values()},
            {"warm_up", job.warmUp}, {"time_limit", job.timeLimitS},
            {"seed", job.seed},      {"folder", job.folder.string()},
            {"cells", Json::array()}};
  if (const auto& range = job.attribute.range) json["range"] = {range->least, range->most};
  for (const auto& cell : job.cells) json["cells"].push_back(cellJson(cell));
  return json;
}

WorkerJob jobOf(const Json& json) {
  WorkerJob job{.input = textAt(json, "input"),
                .attribute = {textAt(json, "attribute"), {}},
                .device = textAt(json, "device"),
                .truth = variantOf(objectAt(json, "truth")),
                .warmUp = wholeAt<unsigned>(json, "warm_up"),
                .timeLimitS = finiteAt(json, "time_limit"),
                .seed = wholeAt<std::uint64_t>(json, "seed"),
                .folder = textAt(json, "folder"),
                .cells = {}};
  if (json.contains("range")) job.attribute.range = ValueRange{pairAt(json, "range")[0], pairAt(json, "range")[1]};
  for (const auto& cell : listAt(json, "cells")) job.cells.push_back(cellOf(cell));
  return job;
}

std::string lineOf(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n'; }

}  // namespace tessera::harness
