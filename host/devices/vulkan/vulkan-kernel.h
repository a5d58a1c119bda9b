// A compute pipeline made from a SPIR-V module and its interface.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/devices/vulkan/memory.h"

namespace tessera::vulkan {

class VulkanKernel : public Kernel {
 public:
  struct Resource {
    std::string name;
    std::uint32_t binding;
  };
  struct Pipeline;  // what the recorded commands need until they have run

  /// Throws kUnsupported, naming the feature or limit, when the device cannot run it.
  VulkanKernel(std::shared_ptr<Machine> machine, const CompiledKernel& compiled);

  const CompiledKernel& compiled() const override { return compiled_; }
  const std::vector<Resource>& storage() const { return storage_; }  ///< structured buffers
  bool hasBlock() const { return hasBlock_; }
  std::uint32_t blockBinding() const { return blockBinding_; }
  const std::shared_ptr<const Pipeline>& pipeline() const { return pipeline_; }

 private:
  CompiledKernel compiled_;
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

}  // namespace tessera::vulkan
