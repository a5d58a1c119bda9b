// Buffers, dispatch and timestamps: all that the rasteriser asks of a machine.
#pragma once

#include <tessera/kernel.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// What a device is and what it can do. The plan is made from it.
struct DeviceInfo {
  std::string api;                       ///< name of its kind, see device-kind.h: "cpu", "vulkan", ...
  std::vector<std::string> routes;       ///< values of the axis `route` that its kernels take; the first is the default
  std::string name;                      ///< e.g. "AMD EPYC" or "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string driver;                    ///< driver name and version; compiler and target on the CPU
  unsigned threads = 0;                  ///< host threads that run its kernels; 0 where the host runs none
  bool correctnessOnly = false;          ///< a software Vulkan driver: its times say nothing about a GPU
  bool int64 = true;                     ///< 64-bit integers in kernels
  bool float64 = true;                   ///< 64-bit floats in kernels
  bool atomicMin64 = true;               ///< 64-bit atomic min on storage buffers
  bool groupAtomicMin64 = true;          ///< 64-bit atomic min in group memory
  std::uint64_t maxBufferBytes = ~0ull;  ///< largest storage buffer that a kernel can bind
  std::uint32_t maxLoopIterations =
      ~0u;  ///< per invocation, over all its loops; lavapipe 22.3 drops what is beyond 65,535
  std::uint32_t maxGroupsPerDimension = 65535;  ///< workgroups of a dispatch along x and along y
  std::uint64_t maxGroupBytes = 32768;          ///< bytes of group memory that a workgroup can have
  std::string timeClock;  ///< what StageTime is read from: "timestamp" (the device's) or "wall" (the host's)
};

/// Memory of a device, made by Device::createBuffer(). A buffer may outlive its device.
class Buffer {
 public:
  virtual ~Buffer() = default;
  /// The size in bytes that createBuffer() was asked for.
  virtual std::size_t bytes() const = 0;
};

/// A kernel that a device has loaded, made by Device::createKernel().
class Kernel {
 public:
  virtual ~Kernel() = default;
  /// The compiled kernel that createKernel() was given.
  virtual const CompiledKernel& compiled() const = 0;
};

/// A buffer bound to a resource of a kernel, by the resource's name in the Slang source.
struct Binding {
  std::string_view name;           ///< the resource's name
  const Buffer* buffer = nullptr;  ///< a buffer of the device that runs the kernel
};

/// Time between the start and the end of one dispatch, in the order of recording.
struct StageTime {
  std::string stage;          ///< the kernel's CompiledKernel::stage
  std::uint64_t beginNs = 0;  ///< nanoseconds; one clock for all dispatches, so that gaps can be seen
  std::uint64_t endNs = 0;    ///< nanoseconds of the same clock
};

/// Group g of a dispatch of n groups is SV_GroupID.x + SV_GroupID.y * kGroupRow; kernels bound-check, since the last
/// row may be ragged.
inline constexpr std::uint32_t kGroupRow = 32768;

/// A machine that runs kernels. Everything recorded on a device runs in the order of recording, each dispatch seeing
/// all writes before it. Not thread-safe: one host thread drives one device. Failures throw Error.
class Device {
 public:
  virtual ~Device() = default;
  /// Does not change while the device lives.
  virtual const DeviceInfo& info() const = 0;

  /// Makes a buffer; `name` is for messages. `bytes` may be 0 (a buffer of one element's size is made). Contents are
  /// undefined. Throws kUnsupported beyond maxBufferBytes.
  virtual std::unique_ptr<Buffer> createBuffer(std::size_t bytes, std::string_view name) = 0;
  /// A buffer that is this memory itself, for kernels to read: the memory stays the caller's, and has to be there and
  /// unchanged until the buffer is destroyed. Null where the device cannot read the host's memory; the caller copies
  /// then.
  virtual std::unique_ptr<Buffer> borrow(std::span<const std::byte> memory, std::string_view name) {
    static_cast<void>(memory), static_cast<void>(name);
    return nullptr;
  }
  /// Loads a kernel, which has to be compiled by one of DeviceInfo::routes. Throws kUnsupported where the kernel needs
  /// what the device does not have, kFailure where it cannot be loaded.
  virtual std::unique_ptr<Kernel> createKernel(const CompiledKernel& kernel) = 0;

  /// Copies host memory into a buffer at `offset` bytes. Ordered after what was recorded before.
  virtual void write(Buffer& buffer, std::size_t offset, std::span<const std::byte> data) = 0;
  /// Runs what was recorded, waits for it, copies data.size() bytes at `offset` of a buffer to host memory.
  virtual void read(const Buffer& buffer, std::size_t offset, std::span<std::byte> data) = 0;
  /// Records setting `bytes` bytes (a multiple of 4) at `offset` to a repeated 32-bit value.
  virtual void fill(Buffer& buffer, std::size_t offset, std::size_t bytes, std::uint32_t value) = 0;
  /// Records `groups` workgroups (0 is allowed and does nothing). `block` holds the uniform block of this dispatch
  /// (copied). Every resource in the kernel's interface but the block must be in `bindings`; extra bindings are
  /// ignored.
  virtual void dispatch(const Kernel& kernel, std::span<const Binding> bindings, std::span<const std::byte> block,
                        std::uint32_t groups) = 0;
  /// Runs what was recorded and waits for it.
  virtual void finish() = 0;
  /// Times of the dispatches since the last call; implies finish().
  virtual std::vector<StageTime> takeTimes() = 0;
  /// Peak bytes held by buffers of this device since its creation.
  virtual std::uint64_t peakBufferBytes() const = 0;
};

}  // namespace tessera
