// The kernels, buffers and uniforms of the frames of one device, and the dispatch of a stage by its name. The
// dispatcher knows stages and buffers from their lists in host/plan.
#pragma once

#include <tessera/device.h>
#include <tessera/kernel-cache.h>
#include <tessera/plan.h>

#include <bit>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/plan/stages.h"

namespace tessera::frame {

/// The last word of a buffer that a kernel can name: kernels index with 32 bits.
inline constexpr std::uint64_t kMaxWord = 0xffffffff;

/// Dispatches stages on one device.
class Dispatcher {
 public:
  Dispatcher(Device& device, KernelCache& cache) : device_(device), cache_(cache) {}

  Device& device() const { return device_; }

  /// Compiles and loads the kernels of the plan's stages, where they are not loaded yet. The plan is in force from then
  /// on. Throws kFailure where a kernel names a buffer that is neither in the list of buffers nor a stream of the
  /// scene, or where a kernel gives a buffer's elements another size.
  void prepare(const Plan& plan, const Scene& scene);

  /// Sets a field of the uniform block `Frame` of slang's layout, for the dispatches that follow.
  void set(std::string_view field, std::uint32_t value) { uniforms_.insert_or_assign(std::string(field), value); }
  void set(std::string_view field, float value) { set(field, std::bit_cast<std::uint32_t>(value)); }
  /// The value of a field. Throws kFailure with the field's name where no call has set the field.
  std::uint32_t get(std::string_view field) const;

  /// How many elements the extent has with the current uniforms.
  std::uint64_t count(plan::Extent extent) const;
  /// The size in bytes that the list of buffers gives the buffer with the current uniforms.
  std::uint64_t bytesOf(std::string_view buffer) const;
  /// Whether the buffer, at its size with the current uniforms, fits the device, and kernels can index its words with
  /// 32 bits.
  bool fits(std::string_view buffer) const;
  /// The same for so many elements, which a uniform may have no room for.
  bool fits(std::string_view buffer, std::uint64_t elements) const;
  /// Makes room for the buffer, at least of the size that the list of buffers gives. A buffer that grows loses what it
  /// held. Buffers are reused between frames. With `as`, the buffer has this name, and bind() binds it.
  Buffer& allocate(std::string_view buffer) { return allocate(buffer, buffer); }
  Buffer& allocate(std::string_view buffer, std::string_view as);
  /// Makes room for each buffer of this extent that a kernel of the plan in force names. Inputs, and names that bind()
  /// has bound to another buffer, are left out.
  void allocateAll(plan::Extent extent);
  /// Whether a kernel of the plan in force names the buffer.
  bool uses(std::string_view buffer) const { return used_.contains(buffer); }
  /// Binds the buffer `as` where kernels say `name`, until the next call for `name`.
  void bind(std::string_view name, std::string_view as) {
    aliases_.insert_or_assign(std::string(name), std::string(as));
  }

  /// Makes the buffer `name` hold these values. The device reads the values in place where it can, and copies them
  /// otherwise. A kernel that may write the buffer gets a copy in any case. The input stays until dropInputs().
  template <typename T>
  void input(std::string_view name, std::span<const T> values) {
    inputBytes(name, std::as_bytes(values));
  }
  /// Lets go of the buffers that `gone` says of by name, and of what bind() has bound to them. Kernels that name them
  /// then mean the buffer of the name itself.
  void drop(const std::function<bool(std::string_view name)>& gone);
  /// Forgets the memory of all inputs. The memory is the caller's, and need not be there any longer.
  void dropInputs();

  /// Dispatches a stage once, over what the list of stages says.
  void dispatch(std::string_view stage);
  /// Dispatches once each stage of the plan in force that runs at this moment.
  void dispatchAll(plan::Moment moment);
  /// The plan in force.
  const Plan& plan() const { return plan_; }

  /// Reads `count` elements of the buffer, from the element `first` on.
  template <typename T>
  std::vector<T> read(std::string_view name, std::size_t count, std::size_t first = 0) {
    std::vector<T> values(count);
    if (count > 0) device_.read(held(name), first * sizeof(T), std::as_writable_bytes(std::span(values)));
    return values;
  }
  /// Zeroes `words` 32-bit words of the buffer, from the word `first` on.
  void zero(std::string_view name, std::size_t words, std::size_t first = 0);
  /// Zeroes the whole buffer, at the size that the list of buffers gives.
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
  Plan plan_;                                                           // the plan in force
  std::map<std::string, std::unique_ptr<Kernel>, std::less<>> loaded_;  // by content hash
  std::set<std::string, std::less<>> used_;                             // buffers that its kernels name
  std::map<std::string, Kernel*, std::less<>> kernels_;                 // kernels of the plan in force, by stage
  std::map<std::string, std::unique_ptr<Buffer>, std::less<>> buffers_;
  std::map<std::string, Input, std::less<>> inputs_;  // inputs that the device reads in place
  std::map<std::string, std::string, std::less<>> aliases_;
  std::map<std::string, std::uint32_t, std::less<>> uniforms_;
};

}  // namespace tessera::frame
