// Kernels, buffers and uniforms of the frames of one device; dispatch by stage name. No order of stages is known here.
#pragma once

#include <tessera/device.h>
#include <tessera/kernel-cache.h>
#include <tessera/plan.h>

#include <bit>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

class Passes {
 public:
  Passes(Device& device, KernelCache& cache) : device_(device), cache_(cache) {}

  Device& device() const { return device_; }

  /// Compiles and loads what the plan's stages need and is not loaded yet.
  void prepare(const Plan& plan);

  /// A field of the uniform block `Frame` of slang/records/layout.slang, for the dispatches that follow.
  void set(std::string_view field, std::uint32_t value) { uniforms_.insert_or_assign(std::string(field), value); }
  void set(std::string_view field, float value) { set(field, std::bit_cast<std::uint32_t>(value)); }
  std::uint32_t get(std::string_view field) const { return uniforms_.find(field)->second; }

  /// The buffer that kernels know by this name, at least so large; what it held is lost when it grows. Reused between
  /// frames.
  Buffer& buffer(std::string_view name, std::size_t bytes);
  /// Whether a kernel of the plan in force names it.
  bool uses(std::string_view name) const;
  /// As it is. It has to be there.
  Buffer& buffer(std::string_view name) { return *buffers_.find(name)->second; }
  /// What kernels know by `name` is the buffer `as`, until said otherwise.
  void bind(std::string_view name, std::string_view as) {
    aliases_.insert_or_assign(std::string(name), std::string(as));
  }

  /// One lane an element: enough groups of kLanes lanes.
  void overElements(std::string_view stage, std::uint64_t elements);
  void overGroups(std::string_view stage, std::uint64_t groups);

  template <typename T>
  std::vector<T> read(std::string_view name, std::size_t count, std::size_t first = 0) {
    std::vector<T> values(count);
    if (count > 0) device_.read(buffer(name), first * sizeof(T), std::as_writable_bytes(std::span(values)));
    return values;
  }
  template <typename T>
  void write(std::string_view name, const std::vector<T>& values) {
    write(name, std::span<const T>(values));
  }
  template <typename T>
  void write(std::string_view name, std::span<const T> values) {
    Buffer& target = buffer(name, values.size_bytes());
    if (!values.empty()) device_.write(target, 0, std::as_bytes(values));
  }
  void zero(std::string_view name, std::size_t words, std::size_t first = 0) {
    device_.fill(buffer(name), 4 * first, 4 * words, 0);
  }

  static constexpr std::uint32_t kLanes = 64;  ///< slang/machine/workgroup.slang has the same

 private:
  Device& device_;
  KernelCache& cache_;
  std::map<std::string, std::unique_ptr<Kernel>, std::less<>> loaded_;  // by content hash
  std::map<std::string, Kernel*, std::less<>> kernels_;                 // of the plan in force, by stage
  std::map<std::string, std::unique_ptr<Buffer>, std::less<>> buffers_;
  std::map<std::string, std::string, std::less<>> aliases_;
  std::map<std::string, std::uint32_t, std::less<>> uniforms_;
};

}  // namespace tessera
