#include "host/devices/vulkan/vulkan-kernel.h"

#include <fmt/format.h>

#include <spirv/unified1/spirv.hpp>
#include <utility>

#include "host/axes/routes.h"
#include "host/devices/kernel-fault.h"
#include "host/devices/vulkan/spirv-module.h"

namespace tessera::devices::vulkan {
namespace {

constexpr std::string_view kBlockName = "frame";

/// One line for each capability of the module that the device has to be asked about.
void checkCapabilities(const SpirvModule& module, const Adapter& adapter, const std::string& who) {
  const auto& f = adapter.features;
  const auto& f12 = adapter.features12;
  struct Need {
    std::uint32_t capability;
    vk::Bool32 there;
    const char* what;
  };
  const Need needs[] = {
      {spv::CapabilityFloat64, f.shaderFloat64, "64-bit floats (shaderFloat64)"},
      {spv::CapabilityInt64, f.shaderInt64, "64-bit integers (shaderInt64)"},
      // SPIR-V does not tell atomics on buffers from atomics in group memory: the plan asks for each by its Needs.
      {spv::CapabilityInt64Atomics, f12.shaderBufferInt64Atomics || f12.shaderSharedInt64Atomics,
       "64-bit atomics (shaderBufferInt64Atomics, shaderSharedInt64Atomics)"},
      {spv::CapabilityVulkanMemoryModel, f12.vulkanMemoryModel, "the Vulkan memory model (vulkanMemoryModel)"},
  };
  for (std::uint32_t capability : module.capabilities)
    for (const Need& need : needs)
      if (need.capability == capability && !need.there)
        failUnsupported(fmt::format("{}: it needs {}, which {} does not have", who, need.what, adapter.name()));
}

void checkLimits(const SpirvModule& module, std::size_t storageBuffers, const Adapter& adapter,
                 const std::string& who) {
  const auto& limits = adapter.properties.limits;
  const auto refuse = [&](const char* what, std::uint64_t needed, std::uint64_t limit) {
    if (needed > limit)
      failUnsupported(fmt::format("{}: it needs {} {}, {} has {}", who, needed, what, adapter.name(), limit));
  };
  const auto& size = module.localSize;
  refuse("threads a group", std::uint64_t{size[0]} * size[1] * size[2], limits.maxComputeWorkGroupInvocations);
  for (std::size_t i = 0; i < size.size(); ++i)
    refuse("threads along a group", size[i], limits.maxComputeWorkGroupSize[i]);
  refuse("bytes of group memory", module.groupMemoryBytes, limits.maxComputeSharedMemorySize);
  refuse("storage buffers", storageBuffers, limits.maxPerStageDescriptorStorageBuffers);
}

}  // namespace

VulkanKernel::VulkanKernel(std::shared_ptr<Machine> machine, const CompiledKernel& compiled)
    : compiled_(compiled), description_(describe(compiled, "vulkan")) {
  const std::string who = fmt::format("kernel {}", compiled.stage);
  if (!axes::routeInfo(compiled.route).spirv) fail(who + ": compiled for the CPU, a Vulkan device takes SPIR-V");
  SpirvModule module = readModule(compiled.binary);

  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  for (const auto& [name, binding] : compiled.interface.resources) {
    const bool isBlock = name == kBlockName;
    if (isBlock) {
      hasBlock_ = true;
      blockBinding_ = binding;
    } else {
      storage_.push_back({name, binding});
    }
    bindings.emplace_back(binding, isBlock ? vk::DescriptorType::eUniformBuffer : vk::DescriptorType::eStorageBuffer, 1,
                          vk::ShaderStageFlagBits::eCompute);
  }
  checkCapabilities(module, machine->adapter, who);
  checkLimits(module, storage_.size(), machine->adapter, who);
  if (machine->boundsChecks) {
    addChecks(module.words, machine->adapter);
    bindings.emplace_back(checks_->binding, vk::DescriptorType::eStorageBuffer, 1, vk::ShaderStageFlagBits::eCompute);
  }

  auto made = std::make_shared<Pipeline>();
  made->machine = machine;
  translated(fmt::format("vulkan: {} ({})", who, compiled.binary.string()), [&] {
    const auto& device = machine->device;
    made->setLayout = {device, vk::DescriptorSetLayoutCreateInfo({}, bindings)};
    made->layout = {device, vk::PipelineLayoutCreateInfo({}, *made->setLayout)};
    const vk::raii::ShaderModule code(device, vk::ShaderModuleCreateInfo({}, module.words));
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *code, module.entry.c_str());
    made->pipeline = {device, nullptr, vk::ComputePipelineCreateInfo({}, stage, *made->layout)};
  });
  pipeline_ = std::move(made);
}

void VulkanKernel::addChecks(std::vector<std::uint32_t>& words, const Adapter& adapter) {
  const std::uint32_t most = adapter.properties.limits.maxPerStageDescriptorStorageBuffers;
  if (storage_.size() + 1 > most)
    failUsage(fmt::format("{}: bounds checks need a storage buffer beside its {}, all that {} has", description_,
                          storage_.size(), adapter.name()));
  try {
    checks_ = kernels::addBoundsChecks(words, compiled_.interface.resources);
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}", description_, error.what()));
  }
  words = std::exchange(checks_->words, {});
  storage_.push_back({std::string(kFaultsName), checks_->binding});
}

}  // namespace tessera::devices::vulkan
