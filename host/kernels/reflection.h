// slangc's reflection JSON -> KernelInterface, and a KernelInterface to and from the cache's own JSON.
#pragma once

#include <tessera/kernel.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace tessera::kernels {

/// `json`: what `slangc -reflection-json` wrote; `text`: the C++ that slangc wrote, where the route goes on from C++,
/// which tells the resources that it never touches; the reflection for SPIR-V and GLSL says that itself. Resources that
/// are not used are left out: nobody must bind them. Throws kFailure where the JSON is not what we know.
KernelInterface readReflection(const std::string& json, Route route, const std::string& text);

nlohmann::json toJson(const KernelInterface& interface);
KernelInterface interfaceFromJson(const nlohmann::json& json);

}  // namespace tessera::kernels
