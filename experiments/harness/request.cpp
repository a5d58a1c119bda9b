#include "experiments/harness/request.h"

namespace tessera::harness {
namespace {

Variant variantOf(const Json& json) {
  Variant variant;
  for (const auto& [axis, value] : json.items()) variant.set(axis, value.get<std::string>());
  return variant;
}

Json cellJson(const WorkerCell& cell) {
  Json json{{"number", cell.number},
            {"size", {cell.size.width, cell.size.height}},
            {"threads", cell.threads},
            {"asked", cell.asked.values()},
            {"kernels", Json::object()}};
  for (const auto& [stage, file] : cell.kernels) json["kernels"][stage] = file.string();
  return json;
}

WorkerCell cellOf(const Json& json) {
  WorkerCell cell{.number = json["number"],
                  .size = {json["size"][0], json["size"][1]},
                  .threads = json["threads"],
                  .asked = variantOf(json["asked"]),
                  .kernels = {}};
  for (const auto& [stage, file] : json["kernels"].items()) cell.kernels[stage] = file.get<std::string>();
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
  WorkerJob job{.input = json["input"],
                .attribute = {json["attribute"], {}},
                .device = json["device"],
                .truth = variantOf(json["truth"]),
                .warmUp = json["warm_up"],
                .timeLimitS = json["time_limit"],
                .seed = json["seed"],
                .folder = json["folder"].get<std::string>(),
                .cells = {}};
  if (json.contains("range")) job.attribute.range = ValueRange{json["range"][0], json["range"][1]};
  for (const auto& cell : json["cells"]) job.cells.push_back(cellOf(cell));
  return job;
}

std::string lineOf(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n'; }

}  // namespace tessera::harness
