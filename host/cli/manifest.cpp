#include "host/cli/manifest.h"

#include <fmt/format.h>
#include <tessera/counters.h>
#include <tessera/error.h>
#include <tessera/rasterizer.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>

#include "host/build-info.h"
#include "host/cli/recorder.h"
#include "host/devices/open.h"
#include "host/plan/buffers.h"
#include "host/plan/stages.h"

namespace tessera::cli {
namespace {

using Json = nlohmann::ordered_json;

// ---- what slangc says of a stage

std::string scalarName(const std::string& slang) {
  static const std::map<std::string, std::string> names{{"float32", "f32"}, {"uint32", "u32"}, {"int32", "i32"},
                                                        {"uint64", "u64"},  {"int64", "i64"},  {"float64", "f64"}};
  const auto found = names.find(slang);
  return found == names.end() ? slang : found->second;
}

std::uint32_t bytesOf(const Json& type) {
  if (!type.contains("sizes")) return 0;
  for (const Json& size : type.at("sizes"))
    if (size.at("kind") == "uniform") {
      const std::uint32_t bytes = size.at("value"), alignment = size.value("alignment", 1u);
      return (bytes + alignment - 1) / alignment * alignment;
    }
  return 0;
}

/// What the file calls it: slangc puts a number behind some names, and keeps others.
Json nameInText(const std::string& text, const std::string& name, const kernels::EmitTarget& target) {
  if (target.name == "spirv") return nullptr;
  const bool member = target.name == "cpp" || target.name == "cuda";
  std::smatch found;
  if (member && std::regex_search(text, found, std::regex("->(" + name + R"(_\d+)\b)"))) return found[1].str();
  if (std::regex_search(text, std::regex(R"(\b)" + name + R"(\b)"))) return name;
  if (std::regex_search(text, found, std::regex(R"(\b()" + name + R"(_\d+)\b)"))) return found[1].str();
  return nullptr;
}

/// Of a struct, with the file's names; of the others a name such as "u32" or "vec4<f32>".
Json typeOf(const Json& type, const std::string& text, const kernels::EmitTarget& target) {
  const std::string kind = type.at("kind");
  if (kind == "scalar") return scalarName(type.at("scalarType"));
  if (kind == "vector")
    return fmt::format("vec{}<{}>", type.at("elementCount").get<int>(),
                       typeOf(type.at("elementType"), text, target).get<std::string>());
  if (kind != "struct") return type.value("name", kind);
  Json fields = Json::array();
  for (const Json& field : type.at("fields"))
    fields.push_back({{"name", field.at("name")},
                      {"inFile", nameInText(text, field.at("name"), target)},
                      {"type", typeOf(field.at("type"), text, target)},
                      {"offset", field.at("binding").value("offset", 0)}});
  return {{"struct", type.value("name", "")}, {"fields", std::move(fields)}};
}

Json placeOf(const Json& parameter, bool block, bool writable, const kernels::EmitTarget& target) {
  const Json& binding = parameter.at("binding");
  if (target.name == "hlsl")
    return {{"register", fmt::format("{}{}", block ? "b" : writable ? "u" : "t", binding.at("index").get<int>())}};
  if (target.name == "metal") return {{"buffer", binding.at("index")}};
  if (binding.contains("offset")) return {{"offset", binding.at("offset")}};  // in the struct of globals
  return {{"group", 0}, {"binding", binding.at("index")}};
}

/// slangc's C++ and CUDA keep every buffer in the struct of globals.
bool isUsed(const Json& reflection, const std::string& name, const Json& inText, const kernels::EmitTarget& target) {
  if (target.name == "cpp" || target.name == "cuda") return !inText.is_null();
  for (const Json& bound : reflection.at("entryPoints").at(0).at("bindings"))
    if (bound.at("name") == name) return bound.at("binding").value("used", 1) != 0;
  return true;
}

/// Bytes that a buffer needs at least, as a formula. Null for a stream that is no buffer of the pipeline, and for the
/// offsets of bins that have a place each, which are needed only where the bins run again at their counted sizes.
Json sizeOf(const std::string& name, const Plan& plan) {
  const plan::BufferDoc* const doc = plan::findBuffer(name);
  if (doc == nullptr || name == "counters" || (name == "offsets" && !plan.runs("bin-count"))) return nullptr;
  return fmt::format("{} * {}", doc->bytes, plan::formula(doc->extent));
}

Json stageOf(const WrittenStage& written, const Plan& plan, const kernels::EmitTarget& target) {
  const std::string& stage = written.emitted.stage;
  if (written.file.empty()) return {{"stage", stage}, {"file", nullptr}, {"why", written.emitted.complaint}};
  const std::string& text = written.emitted.bytes;
  const Json reflection = Json::parse(written.emitted.reflection);
  const Json& entry = reflection.at("entryPoints").at(0);
  Json bindings = Json::array(), uniforms;
  for (const Json& parameter : reflection.at("parameters")) {
    const std::string name = parameter.at("name");
    const Json& type = parameter.at("type");
    const Json inText = nameInText(text, name, target);
    if (!isUsed(reflection, name, inText, target)) continue;
    const bool block = type.at("kind") == "constantBuffer";
    const bool writable = type.value("access", "read") != "read";
    Json resource{{"name", name}, {"inFile", inText}, {"place", placeOf(parameter, block, writable, target)}};
    if (block) {
      resource["bytes"] = bytesOf(type.at("elementType"));
      resource["fields"] = typeOf(type.at("elementType"), text, target).at("fields");
      uniforms = std::move(resource);
    } else {
      resource["access"] = writable ? "read_write" : "read";
      resource["element"] = typeOf(type.at("resultType"), text, target);
      resource["elementBytes"] = bytesOf(type.at("resultType"));
      resource["bytes"] = sizeOf(name, plan);
      bindings.push_back(std::move(resource));
    }
  }
  // Vulkan's modules call it main.
  const std::string name =
      target.name == "spirv" || target.name == "glsl" ? "main" : entry.at("name").get<std::string>();
  return {{"stage", stage},
          {"file", written.file},
          {"entryPoint", name},
          {"workgroupSize", entry.at("threadGroupSize")},
          {"groups", plan::groupFormula(tessera::plan::stageOf(stage))},
          {"uniforms", std::move(uniforms)},
          {"bindings", std::move(bindings)}};
}

// ---- what the frame did

/// The same choices as the plan's on the device that it is recorded on.
Variant recordedVariant(const Scene& scene, const Variant& asked, const Plan& plan, const DeviceInfo& device) {
  Variant variant = asked;
  variant.set("route", device.routes.front());
  const Plan here = makePlan(scene, variant, device);
  for (const auto& [axis, value] : plan.resolved.values())
    if (axis != "route" && here.resolved.get(axis) != value) variant.set(axis, value);
  return variant;
}

/// The channels of the frame: the buffer of each, or of each stream of it.
Json outputs(const Recorder& recorder) {
  Json list = Json::object();
  for (const plan::BufferDoc& doc : tessera::plan::buffers())
    for (const auto& buffer : recorder.buffers())
      if (doc.channel && (buffer.pipeline == doc.name || buffer.pipeline.starts_with(doc.name + ' ')))
        list[buffer.pipeline] = {// the last of that name is the one in use
                                 {"buffer", buffer.name},
                                 {"type", doc.channel->element},
                                 {"empty", doc.channel->empty}};
  return list;
}

}  // namespace

Manifest manifestOf(const Scene& scene, const Variant& asked, const Plan& plan, const kernels::EmitTarget& target,
                    const std::vector<WrittenStage>& stages) {
  Manifest manifest;
  Json json{{"format", "tessera kernels 1"},
            {"tessera", TESSERA_VERSION},
            {"target", target.name},
            {"scene",
             {{"name", scene.name},
              {"width", scene.width},
              {"height", scene.height},
              {"vertices", scene.vertexCount()},
              {"triangles", scene.triangles.size()}}},
            {"variant", plan.resolved.values()}};
  json["stages"] = Json::array();
  for (const WrittenStage& stage : stages) json["stages"].push_back(stageOf(stage, plan, target));
  json["counters"] = Json::array();  // of 64 bits, the low word first
  for (std::size_t i = 0; i < kernelCounterCount(); ++i) json["counters"].push_back(counterDocs()[i].name);
  try {
    const auto device = openDevice(devices::defaultDevice());
    DeviceInfo as = target.device;
    as.routes = device->info().routes;
    Recorder recorder(*device, as);
    KernelCache kernels;
    Rasterizer(recorder, kernels).render(scene, recordedVariant(scene, asked, plan, as));
    json["buffers"] = Json::array();
    for (const auto& buffer : recorder.buffers())
      json["buffers"].push_back({{"name", buffer.name}, {"bytes", buffer.bytes}});
    json["commands"] = recorder.commands();
    json["outputs"] = outputs(recorder);
    manifest.files = recorder.files();
  } catch (const Error& error) {
    json["commands"] = nullptr;
    manifest.complaint = error.what();
  }
  manifest.text = json.dump(1) + '\n';
  return manifest;
}

}  // namespace tessera::cli
