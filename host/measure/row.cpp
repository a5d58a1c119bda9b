#include "host/measure/row.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>
#include <tessera/input.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "host/build-info.h"
#include "host/support/machine.h"
#include "host/support/terminal.h"

namespace tessera::measure {
namespace {

using Json = nlohmann::ordered_json;

/// A version 7 UUID (RFC 9562): 48 bits of milliseconds, then random ones, so that ids sort by time.
std::string makeRunId(std::chrono::system_clock::time_point now) {
  const auto ms =
      static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch()).count());
  std::random_device random;
  const auto bits = [&](unsigned count) { return random() & ((1u << count) - 1); };
  return fmt::format("{:08x}-{:04x}-7{:03x}-{:04x}-{:04x}{:08x}", (ms >> 16) & 0xffffffffu, ms & 0xffffu, bits(12),
                     0x8000u | bits(14), bits(16), random());
}

std::string utcText(std::chrono::system_clock::time_point now) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(now)));
}

std::string osName() {
  utsname name{};
  uname(&name);
  return fmt::format("{} {} {}", name.sysname, name.release, name.machine);
}

Json sceneJson(const Run& run) {
  const Scene& scene = *run.scene;
  Json json = {{"name", scene.name},
               {"sha256", sceneHash(scene)},
               {"triangles", scene.triangles.size()},
               {"size", {scene.width, scene.height}}};
  if (scene.origin != glm::dvec3(0)) json["origin"] = {scene.origin.x, scene.origin.y, scene.origin.z};
  if (!scene.notes.empty()) json["notes"] = scene.notes;
  if (const Stream* stream = scene.attribute()) json["attribute"] = {{"name", stream->name}};
  if (run.attributeRange) json["attribute"]["range"] = {run.attributeRange->least, run.attributeRange->most};
  return json;
}

Json timeJson(const Run& run) {
  std::vector<std::uint64_t> totals;
  for (const auto& sample : run.samples) totals.push_back(sample.totalNs);
  const Spread total = totalSpread(run.samples);
  Json stages = Json::object();
  for (const auto& [stage, median] : stageMedians(run.samples)) stages[stage] = median;
  return {{"samples", totals}, {"median", total.median}, {"min", total.min},
          {"iqr", total.iqr},  {"stages", stages},       {"clock", run.device.timeClock}};
}

Json countJson(const Difference::Count& count) { return count ? Json(*count) : Json(); }

/// Null for what is not there, and since JSON has no infinity for what is not finite.
Json finiteJson(const std::optional<double>& value) { return value && std::isfinite(*value) ? Json(*value) : Json(); }

Json differenceJson(const Difference& difference) {
  return {{"pixels", difference.pixels},
          {"coverage_mismatch", countJson(difference.coverage)},
          {"id_mismatch", countJson(difference.id)},
          {"depth_mismatch", countJson(difference.depth)},
          {"hit_count_mismatch", countJson(difference.hits)},
          {"attribute_mismatch", countJson(difference.attribute)},
          {"colour_mismatch", countJson(difference.colour)},
          {"depth_max_ulp", finiteJson(difference.depthMaxUlp)},
          {"depth_max_abs", finiteJson(difference.depthMaxAbs)},
          {"psnr", finiteJson(difference.psnr)}};
}

Json errorJson(const Run& run) {
  Json json = run.difference ? differenceJson(*run.difference) : Json::object();
  if (run.difference) json["winner_mismatch"] = countJson(run.wrongWinners);
  if (run.hitCountNotOne) json["hit_count_not_one"] = *run.hitCountNotOne;
  if (run.attributeError) {
    json["attribute_max"] = finiteJson(run.attributeError->max);
    json["attribute_rms"] = finiteJson(run.attributeError->rms);
  }
  return json;
}

/// The attribute's error is from the picture that is held to be true, value by value.
Json truthErrorJson(const Run& run) {
  Json json = differenceJson(*run.truthDifference);
  if (run.truthDifference->attribute) {
    json["attribute_max"] = finiteJson(run.truthDifference->attributeMax);
    json["attribute_rms"] = finiteJson(run.truthDifference->attributeRms);
  }
  return json;
}

Json planJson(const std::vector<PlanEntry>& entries) {
  Json json = Json::object();
  for (const auto& entry : entries) json[entry.pass] = {{"kept", entry.kept}, {"why", entry.why}};
  return json;
}

Json provenanceJson(const Run& run, std::chrono::system_clock::time_point now) {
  const std::string git = TESSERA_GIT;
  Json json = {{"git", git},
               {"dirty", git.ends_with("-dirty")},
               {"build_type", TESSERA_BUILD_TYPE},
               {"compiler", TESSERA_COMPILER},
               {"flags", TESSERA_CXX_FLAGS_TEXT}};
  if (!run.slang.empty()) json["slang"] = run.slang;
  if (!run.kernelCompiler.empty()) json["kernel_compiler"] = run.kernelCompiler;
  if (!run.kernels.empty()) json["kernels"] = run.kernels;
  json["device"] = run.device.name;
  json["driver"] = run.device.driver;
  json["api"] = run.device.api;
  if (run.device.threads != 0) json["threads"] = run.device.threads;
  if (run.device.correctnessOnly) json["correctness_only"] = true;  // a software driver: its times rank nothing
  json["os"] = osName();
  json["cpu"] = support::processorName();
  if (run.seed) json["seed"] = *run.seed;
  json["utc"] = utcText(now);
  return json;
}

}  // namespace

Spread spread(std::vector<std::uint64_t> sample) {
  if (sample.empty()) return {};
  std::sort(sample.begin(), sample.end());
  const auto quantile = [&](double q) {
    const double place = q * static_cast<double>(sample.size() - 1);
    const auto low = static_cast<std::size_t>(place);
    const std::size_t high = std::min(low + 1, sample.size() - 1);
    const auto at = [&](std::size_t i) { return static_cast<double>(sample[i]); };
    return at(low) + (place - static_cast<double>(low)) * (at(high) - at(low));
  };
  return {quantile(0.5), quantile(0), quantile(0.75) - quantile(0.25), quantile(1), sample.size()};
}

double Spread::medianError() const {
  return median > 0 ? 1.57 * iqr / std::sqrt(static_cast<double>(count)) / median : 0;
}

Spread totalSpread(const std::vector<FrameTimes>& samples) {
  std::vector<std::uint64_t> totals;
  for (const auto& sample : samples) totals.push_back(sample.totalNs);
  return spread(totals);
}

std::vector<std::pair<std::string, double>> stageMedians(const std::vector<FrameTimes>& samples) {
  std::vector<std::pair<std::string, double>> medians;
  if (samples.empty()) return medians;
  for (const auto& [name, first] : samples.front().stages) {
    std::vector<std::uint64_t> times;
    for (const auto& sample : samples)
      for (const auto& [stage, ns] : sample.stages)
        if (stage == name) times.push_back(ns);
    medians.emplace_back(name, spread(times).median);
  }
  return medians;
}

std::uint64_t coveredPixels(const Framebuffer& frame) {
  const auto count =
      frame.ids.empty()
          ? std::count_if(frame.hits.begin(), frame.hits.end(), [](std::uint32_t hits) { return hits != 0; })
          : std::count_if(frame.ids.begin(), frame.ids.end(), [](std::uint32_t id) { return id != kNoTriangle; });
  return static_cast<std::uint64_t>(count);
}

std::string statusOf(ExitCode code) {
  return code == ExitCode::kOverflow ? "overflow" : code == ExitCode::kUnsupported ? "unsupported" : "error";
}

std::string differenceText(const Difference& difference) { return differenceJson(difference).dump(); }

std::string utcText() { return utcText(std::chrono::system_clock::now()); }

std::string rowText(const Run& run) {
  const auto now = std::chrono::system_clock::now();
  Json row = {{"schema_version", kRowSchemaVersion}, {"run_id", makeRunId(now)}};
  row["variant"] = Json::object();
  for (const auto& [axis, value] : run.variant.values()) row["variant"][axis] = value;
  for (const auto& [stage, file] : run.kernelFiles)
    row["kernel_files"][stage] = {{"file", file.first}, {"sha256", file.second}};
  if (run.scene) row["scene"] = sceneJson(run);
  row["status"] = run.status;
  if (!run.message.empty()) row["message"] = run.message;
  if (!run.samples.empty()) row["time_ns"] = timeJson(run);
  if (const Json error = errorJson(run); !error.empty()) row["error"] = error;
  if (!run.truth.values().empty()) {
    row["truth"] = run.truth.values();
    if (run.truthDifference) row["truth_error"] = truthErrorJson(run);
  }
  if (!run.picture.empty()) row["picture"] = run.picture;
  if (!run.counters.empty()) row["counters"] = run.counters;
  if (run.peakBufferBytes != 0) row["memory"] = {{"peak_buffer_bytes", run.peakBufferBytes}};
  if (!run.plan.empty()) row["plan"] = planJson(run.plan);
  row["provenance"] = provenanceJson(run, now);
  return support::visible(row.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace tessera::measure
