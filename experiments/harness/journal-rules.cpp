#include "experiments/harness/journal-rules.h"

#include <fmt/format.h>
#include <tessera/error.h>
#include <tessera/variant.h>

#include <algorithm>
#include <optional>

#include "datasets/text.h"
#include "experiments/harness/fields.h"
#include "experiments/harness/row-schema.h"
#include "host/plan/stages.h"

namespace tessera::harness {
namespace {

constexpr std::string_view kKernel = "kernel:";

/// Axes and their values are those of the list.
void checkAxes(const Json& settings, const std::string& key) {
  for (const auto& [axis, value] : settings.items()) {
    try {
      Variant().set(axis, textAt(settings, axis.c_str()));
    } catch (const Error& error) {
      throw WrongField(fmt::format("{}.{}: {}", key, axis, error.what()));
    }
  }
}

Labels labelsOf(const Json& asked, const std::string& key) {
  Labels labels;
  Json settings = Json::object();
  for (const auto& [name, value] : asked.items()) {
    labels[name] = value;
    if (!name.starts_with(kKernel))
      settings[name] = value;
    else if (std::ranges::find(plan::stages(), name.substr(kKernel.size()), &plan::Stage::name) == plan::stages().end())
      failField(key + '.' + name, &value, "the kernel of one of the pipeline's stages");
  }
  checkAxes(settings, key);
  return labels;
}

std::optional<Size> sizeOf(const std::string& text) {
  const std::size_t x = text.find('x');
  if (x == text.npos) return {};
  const auto width = datasets::toInteger(text.substr(0, x)), height = datasets::toInteger(text.substr(x + 1));
  if (!width || !height || *width < 1 || *height < 1 || *width > kMaxExtent || *height > kMaxExtent) return {};
  return Size{static_cast<std::uint32_t>(*width), static_cast<std::uint32_t>(*height)};
}

std::string valueOf(const std::vector<std::string>& words, std::string_view option) {
  const auto found = std::find(words.begin() + std::min<std::ptrdiff_t>(5, std::ssize(words)), words.end(), option);
  return found == words.end() || found + 1 == words.end() ? "" : *(found + 1);
}

/// No more pixels are wrong than there are.
void checkErrors(const Json& errors, double pixels, const std::string& key) {
  for (const auto& [name, value] : errors.items()) {
    if (name == "pixels" && value != pixels)
      failField(key + '.' + name, &value, fmt::format("{}, the scene's,", pixels));
    if (name.ends_with("_mismatch") && value.is_number() && value > pixels)
      failField(key + '.' + name, &value, fmt::format("a count of up to {} pixels", pixels));
  }
}

double pixelsOf(const Json& row) {
  const Json& size = row.at("scene").at("size");
  return size[0].get<double>() * size[1].get<double>();
}

std::string jobName(const Json& sweep) {
  return sweep.at("scene").get<std::string>() + '@' + sweep.at("device").get<std::string>();
}

}  // namespace

void JournalRules::checkCommand(const Json& cell, const Json& head, const std::string& place) {
  const std::string& text = textAt(cell, "command");
  const Json& sweep = cell.at("sweep");
  const Labels labels = labelsOf(sweep.at("asked"), place + ".sweep.asked");
  const std::vector<std::string> words = commandWords(text);
  const auto size = sizeOf(words.size() > 4 ? words[4] : "");
  const Place found{words.size() > 2 ? words[2] : "", valueOf(words, "--attribute"), valueOf(words, "--range")};
  const std::string own =
      commandText({.input = found.input,
                   .size = size.value_or(Size{}),
                   .device = sweep.at("device"),
                   .threads = sweep.at("threads"),
                   .labels = labels,
                   .attribute = found.attribute,
                   .range = found.range,
                   .frames = head.at("rounds").get<unsigned>() * head.at("repeats").get<unsigned>()});
  const bool isRange = found.range.find_first_not_of("0123456789+-.e,") == std::string::npos;
  const auto& scene = sweep.at("scene").get_ref<const std::string&>();
  if (!size || !isRange || own != text || places_.try_emplace(scene, found).first->second != found)
    failField(place + ".command", &cell.at("command"), "the line of 'tessera render' that the cell's settings give");
  sizes_[cell.at("cell")] = *size;
}

void JournalRules::takeCell(const Json& cell, const Json& head, const std::string& place) {
  textAt(cell, "name");
  const Json& sweep = objectAt(cell, "sweep");
  checkSchema(sweep, "/properties/sweep", place + ".sweep");
  if (member(sweep, "cell") != member(cell, "cell"))
    failField(place + ".sweep.cell", &member(sweep, "cell"), "the cell's number");
  for (const char* const key : {"title", "question", "sha256"})
    if (sweep.at(key) != textAt(objectAt(head, "sweep"), key))
      failField(fmt::format("{}.sweep.{}", place, key), &sweep.at(key), "that of the head's sweep");
  if (sweep.value("quick", false) != flagAt(head, "quick"))
    failField(place + ".sweep.quick", &member(sweep, "quick"), "that of the head");
  if (std::ranges::find(head.at("jobs"), Json(jobName(sweep))) == head.at("jobs").end())
    failField(place + ".sweep.scene", &sweep.at("scene"), "with its device one of the head's jobs");
  checkCommand(cell, head, place);
}

void JournalRules::takeSession(const Json& line, const Json& head) const {
  checkSchema(member(line, "utc"), "/$defs/utc", "utc");
  const Json& load = listAt(line, "load");
  if (load.size() != 3 || !std::ranges::all_of(load, [](const Json& j) { return j.is_number() && j >= 0; }))
    failField("load", &load, "a list of three averages from 0 on");
  const Json& jobs = objectAt(line, "jobs");
  if (jobs.empty()) failField("jobs", &jobs, "an object with each job that had something left to do");
  for (const auto& [name, provenance] : jobs.items()) {
    if (std::ranges::find(head.at("jobs"), Json(name)) == head.at("jobs").end())
      failField("jobs." + name, &provenance, "one of the head's jobs");
    if (!provenance.is_null()) checkSchema(provenance, "/properties/provenance", "jobs." + name);
  }
}

void JournalRules::checkScene(const Json& scene, const Json& cell) {
  const Size size = sizes_.at(cell.at("cell"));
  const Json& found = listAt(scene, "size");
  if (found != Json{size.width, size.height})
    failField("scene.size", &found, fmt::format("[{}, {}], as in the cell's command,", size.width, size.height));
  if (!scene.contains("sha256")) return;  // it ended before its scene was read
  const auto& name = cell.at("sweep").at("scene").get_ref<const std::string&>();
  const Json& other = scenes_.try_emplace({name, found.dump()}, scene).first->second;
  for (const Json* const part : {&other, &scene})  // either may have a key that the other has not
    for (const auto& [key, value] : part->items())
      if (!scene.contains(key) || !other.contains(key) || scene.at(key) != other.at(key))
        failField("scene." + key, scene.contains(key) ? &scene.at(key) : nullptr,
                  "what a line before has for this scene");
  const Json& triangles = member(scene, "triangles");
  if (triangles_.try_emplace(textAt(scene, "sha256"), triangles).first->second != triangles)
    failField("scene.triangles", &triangles, "what a line before has for a scene of this hash");
}

void JournalRules::takeRow(const Json& row, const Json& cell, const Json& head) {
  for (const char* const key : {"sweep", "command", "time_ns", "error_samples"})
    if (row.contains(key)) failField(key, &member(row, key), "a row that has none yet");
  const Json& version = head.at("schema_version");
  if (member(row, "schema_version") != version)
    failField("schema_version", &member(row, "schema_version"),
              fmt::format("that of the journal, {},", version.dump()));
  Json whole = row;
  whole["sweep"] = cell.at("sweep");
  checkSchema(whole, "", "");

  const Json &variant = row.at("variant"), &asked = cell.at("sweep").at("asked");
  checkAxes(variant, "variant");
  for (const auto& [axis, value] : asked.items())
    if (!axis.starts_with(kKernel) && (!variant.contains(axis) || variant.at(axis) != value))
      failField("variant." + axis, variant.contains(axis) ? &variant.at(axis) : nullptr,
                fmt::format("{}, as the head has asked,", value.dump()));
  const Json truth = row.value("truth", Json::object());
  checkAxes(truth, "truth");
  if (truth_.is_null()) truth_ = truth;
  if (truth != truth_) failField("truth", row.contains("truth") ? &truth : nullptr, "what the lines before have");
  checkScene(row.at("scene"), cell);
  for (const char* const key : {"error", "truth_error"})
    if (row.contains(key)) checkErrors(row.at(key), pixelsOf(row), key);
  const Json& provenance = row.at("provenance");
  if (provenance.contains("seed") && head.contains("seed") && provenance.at("seed") != head.at("seed"))
    failField("provenance.seed", &provenance.at("seed"), "that of the head");

  if (row.contains("clock")) textAt(row, "clock");
  if (row.contains("kernel_files"))
    for (const auto& [stage, file] : objectAt(row, "kernel_files").items()) {
      textAt(file, "sha256");
      if (asked.value(std::string(kKernel) + stage, "").empty())
        failField("kernel_files." + stage, &file, "a stage for which the head has asked for a file");
    }
  const std::string picture = fmt::format("pictures/{}.png", cell.at("cell").get<std::size_t>());
  if (row.contains("picture") && textAt(row, "picture") != picture)
    failField("picture", &member(row, "picture"), picture);
}

void JournalRules::checkSample(const Json& line, const Json& row) const {
  checkSchema(member(line, "total_ns"), "/$defs/nanoseconds", "total_ns");
  const Json& stages = objectAt(line, "stages");
  const Json& kernels = objectAt(row.at("provenance"), "kernels");
  if (stages.empty()) failField("stages", &stages, "an object with the time of each stage");
  double sum = 0;
  for (const auto& [stage, ns] : stages.items()) {
    checkSchema(ns, "/$defs/nanoseconds", "stages." + stage);
    if (!kernels.contains(stage)) failField("stages." + stage, &ns, "a stage for which the cell's row has a kernel");
    if (!plan::isBehindVisibility(stage)) sum += ns.get<double>();
  }
  // A device's own clock may let its stages overlap; there the whole is only no less than some time.
  const double least = row.value("clock", "") == "wall" ? sum : sum > 0 ? 1 : 0;
  if (line.at("total_ns") < least)
    failField("total_ns", &line.at("total_ns"), fmt::format("{} or more, as its stages say,", least));
  if (line.contains("error")) {
    checkSchema(line.at("error"), "/$defs/errors", "error");
    checkErrors(line.at("error"), pixelsOf(row), "error");
  }
}

}  // namespace tessera::harness
