// Kernels, buffers and uniforms of the frames of one device, and the dispatch of a stage by its name. What the
// dispatcher knows of stages and buffers it has from their lists (host/plan).
#pragma once

#include <tessera/device.h>
#include <tessera/kernel-cache.h>
#include <tessera/plan.h>

#include <bit>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/plan/stages.h"

namespace tessera {

class Dispatcher {
 public:
  Dispatcher(Device& device, KernelCache& cache) : device_(device), cache_(cache) {}

  Device& device() const { return device_; }

  /// Compiles and loads what the plan's stages need and is not loaded yet. Throws kFailure where a kernel names a
  /// buffer that is neither in the list of buffers nor a stream of the scene, or gives its elements another size.
  void prepare(const Plan& plan, const Scene& scene);

  /// A field of the uniform block `Frame` of slang's layout, for the dispatches that follow.
  void set(std::string_view field, std::uint32_t value) { uniforms_.insert_or_assign(std::string(field), value); }
  void set(std::string_view field, float value) { set(field, std::bit_cast<std::uint32_t>(value)); }
  /// Throws kFailure with the name where nothing has set the field.
  std::uint32_t get(std::string_view field) const;

  /// How many there are while the uniforms are as they are.
  std::uint64_t count(Extent extent) const;
  /// Bytes that the list of buffers gives this one while the uniforms are as they are.
  std::uint64_t bytesOf(std::string_view buffer) const;
  /// Whether a buffer of so many bytes fits the device, and kernels can index its words with 32 bits.
  bool fits(std::string_view buffer) const;
  /// Makes room for the buffer, at least as the list says. What the buffer held is lost when it grows. Buffers are
  /// reused between frames. `as`: under a name of its own, to be bound by bind().
  Buffer& allocate(std::string_view buffer) { return allocate(buffer, buffer); }
  Buffer& allocate(std::string_view buffer, std::string_view as);
  /// Makes room for each buffer of this extent that a kernel of the plan in force names, but for what is an input and
  /// what is bound under another name.
  void allocateAll(Extent extent);
  /// Whether a kernel of the plan in force names the buffer.
  bool uses(std::string_view buffer) const;
  /// What kernels know by `name` is the buffer `as`, until said otherwise.
  void bind(std::string_view name, std::string_view as) {
    aliases_.insert_or_assign(std::string(name), std::string(as));
  }

  /// The buffer `name` holds these values: read in place where the device can, else copied. A kernel that may write the
  /// buffer gets a copy in any case. In force until dropInputs().
  template <typename T>
  void input(std::string_view name, std::span<const T> values) {
    inputBytes(name, std::as_bytes(values));
  }
  /// Forgets the memory of all inputs. It is the caller's, and need not be there any longer.
  void dropInputs();

  /// One dispatch of a stage, over what the list of stages says.
  void dispatch(std::string_view stage);
  /// One dispatch of each stage of the plan in force that runs at this moment.
  void dispatchAll(Moment moment);
  const Plan& plan() const { return plan_; }

  template <typename T>
  std::vector<T> read(std::string_view name, std::size_t count, std::size_t first = 0) {
    std::vector<T> values(count);
    if (count > 0) device_.read(held(name), first * sizeof(T), std::as_writable_bytes(std::span(values)));
    return values;
  }
  void zero(std::string_view name, std::size_t words, std::size_t first = 0);
  /// Zeroes all of the buffer that the list gives it.
  void zero(std::string_view name) { zero(name, bytesOf(name) / 4); }

 private:
  struct Input {
    std::span<const std::byte> memory;
    std::unique_ptr<Buffer> buffer;
  };
  void inputBytes(std::string_view name, std::span<const std::byte> bytes);
  void copyInput(std::string_view name, std::span<const std::byte> bytes);
  Buffer& bound(const KernelInterface& interface, const std::string& resource);
  Buffer& reserve(std::string_view name, std::size_t bytes);
  Buffer& held(std::string_view name);

  Device& device_;
  KernelCache& cache_;
  Plan plan_;                                                           // in force
  std::map<std::string, std::unique_ptr<Kernel>, std::less<>> loaded_;  // by content hash
  std::map<std::string, Kernel*, std::less<>> kernels_;                 // of the plan in force, by stage
  std::map<std::string, std::unique_ptr<Buffer>, std::less<>> buffers_;
  std::map<std::string, Input, std::less<>> inputs_;  // that the device reads in place
  std::map<std::string, std::string, std::less<>> aliases_;
  std::map<std::string, std::uint32_t, std::less<>> uniforms_;
};

}  // namespace tessera
