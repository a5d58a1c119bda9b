#include "host/frame/passes.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>
#include <cstring>

#include "host/plan/stages.h"

namespace tessera {

void Passes::prepare(const Plan& plan) {
  const std::vector<CompiledKernel> compiled = compileStages(cache_, plan);
  kernels_.clear();
  for (const CompiledKernel& stage : compiled) {
    auto& kernel = loaded_[stage.hash];
    if (!kernel) kernel = device_.createKernel(stage);
    kernels_[stage.stage] = kernel.get();
  }
}

Buffer& Passes::buffer(std::string_view name, std::size_t bytes) {
  auto& buffer = buffers_[std::string(name)];
  if (!buffer || buffer->bytes() < bytes) {
    if (buffer) device_.finish();  // what was recorded may use the old one
    buffer.reset();                // before the new one is made: both need not fit
    buffer = device_.createBuffer(bytes, name);
  }
  return *buffer;
}

bool Passes::uses(std::string_view name) const {
  return std::ranges::any_of(kernels_, [&](const auto& kernel) {
    const auto& resources = kernel.second->compiled().interface.resources;
    return std::ranges::any_of(resources, [&](const auto& resource) { return resource.first == name; });
  });
}

void Passes::overElements(std::string_view stage, std::uint64_t elements) {
  overGroups(stage, (elements + kLanes - 1) / kLanes);
}

void Passes::overGroups(std::string_view stage, std::uint64_t groups) {
  const Kernel& kernel = *kernels_.find(stage)->second;
  const KernelInterface& interface = kernel.compiled().interface;
  std::vector<std::byte> block(interface.blockSize);
  for (const auto& [name, field] : interface.fields) {
    const auto value = uniforms_.find(name);
    if (value == uniforms_.end()) fail(fmt::format("stage {}: nothing sets the uniform {}", stage, name));
    std::memcpy(block.data() + field.offset, &value->second, sizeof value->second);
  }
  std::vector<Binding> bindings;
  for (const auto& [name, where] : interface.resources) {
    if (name == "frame") continue;
    const auto alias = aliases_.find(name);
    // A kernel names every buffer of its modules, also those that its variant never touches.
    bindings.push_back({name, &buffer(alias == aliases_.end() ? name : alias->second, 0)});
  }
  device_.dispatch(kernel, bindings, block, static_cast<std::uint32_t>(groups));
}

}  // namespace tessera
