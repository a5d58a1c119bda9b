#include "host/kernels/reflection.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <set>

#include "host/axes/routes.h"

namespace tessera::kernels {
namespace {

using nlohmann::json;

struct Size {
  std::uint32_t value = 0, alignment = 1;
};

/// Bytes of a type in memory, as laid out for this route.
Size uniformSize(const json& type) {
  for (const json& size : type.at("sizes"))
    if (size.at("kind") == "uniform") return {size.at("value"), size.at("alignment")};
  return {};
}

constexpr std::uint32_t roundUp(std::uint32_t value, std::uint32_t alignment) {
  return (value + alignment - 1) / alignment * alignment;
}

/// slangc's C++ keeps every global in the struct of parameters, and writes `...->name_0` where one is used.
bool appearsIn(const std::string& text, const std::string& name) {
  const std::string use = "->" + name + "_";
  for (std::size_t at = text.find(use); at != std::string::npos; at = text.find(use, at + 1))
    if (at + use.size() < text.size() && std::isdigit(static_cast<unsigned char>(text[at + use.size()]))) return true;
  return false;
}

std::set<std::string> unusedResources(const json& reflection, Route route, const std::string& text) {
  std::set<std::string> unused;
  if (!axes::routeInfo(route).spirv) {
    for (const json& parameter : reflection.at("parameters"))
      if (const std::string name = parameter.at("name"); !appearsIn(text, name)) unused.insert(name);
  } else {
    for (const json& bound : reflection.at("entryPoints").at(0).at("bindings"))
      if (bound.at("binding").value("used", 1) == 0) unused.insert(bound.at("name").get<std::string>());
  }
  return unused;
}

void readBlock(const json& block, KernelInterface& interface) {
  for (const json& field : block.at("fields")) {
    const json& binding = field.at("binding");
    interface.fields[field.at("name")] = {binding.at("offset"), binding.at("size"),
                                          field.at("type").value("scalarType", "") == "float32"};
  }
  interface.blockSize = uniformSize(block).value;
}

}  // namespace

KernelInterface readReflection(const std::string& text, Route route, const std::string& generated) try {
  const json reflection = json::parse(text);
  const bool spirv = axes::routeInfo(route).spirv;
  const std::set<std::string> unused = unusedResources(reflection, route, generated);
  KernelInterface interface;
  for (const json& parameter : reflection.at("parameters")) {
    const std::string name = parameter.at("name");
    const json& binding = parameter.at("binding");
    const json& type = parameter.at("type");
    const std::uint32_t place = binding.at(spirv ? "index" : "offset");
    if (!spirv)
      interface.globalsSize =
          std::max(interface.globalsSize, roundUp(place + binding.at("size").get<std::uint32_t>(), 8));
    else if (binding.value("space", 0) != 0)
      fail(fmt::format("`{}` is in descriptor set {}; Tessera binds set 0 only", name, binding["space"].dump()));
    if (unused.count(name)) continue;
    if (type.at("kind") == "constantBuffer") {
      if (name != "frame") fail(fmt::format("constant buffer `{}`: a kernel has one, named `frame`", name));
      readBlock(type.at("elementType"), interface);
    } else if (type.at("kind") == "resource" && type.at("baseShape") == "structuredBuffer") {
      const Size element = uniformSize(type.at("resultType"));
      interface.elementSizes[name] = roundUp(element.value, element.alignment);
      if (type.value("access", "read") != "read") interface.writable.insert(name);
    } else {
      fail(fmt::format("`{}` is neither a structured buffer nor the constant buffer `frame`", name));
    }
    if (!interface.resources.emplace(name, place).second)
      fail(fmt::format("two buffers are named {}: buffers are bound by name, so its modules must share one", name));
  }
  reflection.at("entryPoints").at(0).at("threadGroupSize").get_to(interface.groupSize);
  return interface;
} catch (const json::exception& error) {
  fail(fmt::format("slangc's reflection JSON is not as expected: {}", error.what()));
}

json toJson(const KernelInterface& interface) {
  json fields = json::object();
  for (const auto& [name, field] : interface.fields) fields[name] = {field.offset, field.size, field.floating};
  return {{"fields", fields},
          {"blockSize", interface.blockSize},
          {"resources", interface.resources},
          {"elementSizes", interface.elementSizes},
          {"writable", interface.writable},
          {"groupSize", interface.groupSize},
          {"globalsSize", interface.globalsSize}};
}

KernelInterface interfaceFromJson(const json& stored) {
  KernelInterface interface;
  for (const auto& [name, field] : stored.at("fields").items())
    interface.fields[name] = {field.at(0), field.at(1), field.at(2)};
  interface.blockSize = stored.at("blockSize");
  interface.resources = stored.at("resources").get<std::map<std::string, std::uint32_t>>();
  interface.elementSizes = stored.at("elementSizes").get<std::map<std::string, std::uint32_t>>();
  stored.at("writable").get_to(interface.writable);
  stored.at("groupSize").get_to(interface.groupSize);
  interface.globalsSize = stored.at("globalsSize");
  return interface;
}

}  // namespace tessera::kernels
