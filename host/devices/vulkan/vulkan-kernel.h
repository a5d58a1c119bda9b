// A compute pipeline made from a SPIR-V module and its interface.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/devices/vulkan/memory.h"
#include "host/kernels/spirv-bounds.h"

namespace tessera::devices::vulkan {

/// What storage() calls the device's FaultRecord.
inline constexpr std::string_view kFaultsName;

class VulkanKernel : public Kernel {
 public:
  struct Resource {
    std::string name;
    std::uint32_t binding;
  };
  struct Pipeline;  // what the recorded commands need until they have run

  /// With checks built in if the machine asks for them. Throws kUnsupported, naming the feature or limit, when the
  /// device cannot run it, and kUsage where it cannot be checked.
  VulkanKernel(std::shared_ptr<Machine> machine, const CompiledKernel& compiled);

  const CompiledKernel& compiled() const override { return compiled_; }
  /// Structured buffers, and of a checked kernel the device's FaultRecord behind them.
  const std::vector<Resource>& storage() const { return storage_; }
  const char* description() const { return description_.c_str(); }       ///< as messages call it
  const std::optional<kernels::CheckedSpirv>& checks() const { return checks_; }  ///< its words are with the driver
  bool hasBlock() const { return hasBlock_; }
  std::uint32_t blockBinding() const { return blockBinding_; }
  const std::shared_ptr<const Pipeline>& pipeline() const { return pipeline_; }

 private:
  /// Of the module, whose resources are known.
  void addChecks(std::vector<std::uint32_t>& words, const Adapter& adapter);

  CompiledKernel compiled_;
  std::string description_;
  std::optional<kernels::CheckedSpirv> checks_;
  std::vector<Resource> storage_;
  bool hasBlock_ = false;
  std::uint32_t blockBinding_ = 0;
  std::shared_ptr<const Pipeline> pipeline_;
};

struct VulkanKernel::Pipeline {
  std::shared_ptr<Machine> machine;
  vk::raii::DescriptorSetLayout setLayout = nullptr;
  vk::raii::PipelineLayout layout = nullptr;
  vk::raii::Pipeline pipeline = nullptr;
};

}  // namespace tessera::devices::vulkan
