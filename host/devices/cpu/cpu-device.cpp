#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <tessera/cpu-device.h>
#include <tessera/error.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <numeric>
#include <random>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "host/axes/routes.h"
#include "host/devices/cpu/crew.h"
#include "host/devices/kernel-fault.h"
#include "host/devices/kinds.h"
#include "host/kernels/compiler-tools.h"
#include "host/support/machine.h"

namespace tessera {
namespace {

#ifdef TESSERA_PLAIN_THREADS
constexpr bool kPlainThreads = true;  // the thread sanitizer cannot see into oneTBB
#else
constexpr bool kPlainThreads = false;
#endif

constexpr std::size_t kCacheLine = 64;
constexpr std::size_t kHugePage = 2u << 20;
constexpr std::size_t kFillPiece = 64u << 10;  // bytes a piece of a fill

/// Bytes held now and at most; buffers may outlive their device.
struct Ledger {
  std::uint64_t now = 0, peak = 0;
};

/// Bytes of memory that kernels see, counted while the buffer is there.
class CpuBuffer : public Buffer {
 public:
  CpuBuffer(std::byte* data, std::size_t bytes, std::shared_ptr<Ledger> ledger)
      : data_(data), bytes_(bytes), ledger_(std::move(ledger)) {
    ledger_->now += bytes_;
    ledger_->peak = std::max(ledger_->peak, ledger_->now);
  }
  ~CpuBuffer() override { ledger_->now -= bytes_; }
  CpuBuffer(const CpuBuffer&) = delete;

  std::size_t bytes() const override { return bytes_; }
  std::byte* data() const { return data_; }

 private:
  std::byte* data_;
  std::size_t bytes_;
  std::shared_ptr<Ledger> ledger_;
};

/// Memory of the buffer's own.
class OwnedBuffer final : public CpuBuffer {
 public:
  OwnedBuffer(std::size_t bytes, std::string_view name, std::shared_ptr<Ledger> ledger)
      : CpuBuffer(take(bytes, name), bytes, std::move(ledger)) {}
  ~OwnedBuffer() override { std::free(data()); }

 private:
  static std::byte* take(std::size_t bytes, std::string_view name) {
    const bool large = bytes >= kHugePage;
    void* data = nullptr;
    if (posix_memalign(&data, large ? kHugePage : kCacheLine, std::max(bytes, kCacheLine)) != 0)
      fail(fmt::format("cpu: no memory for buffer {} of {} bytes", name, bytes));
    if (large) madvise(data, bytes, MADV_HUGEPAGE);  // advice: a kernel without huge pages may refuse
    return static_cast<std::byte*>(data);
  }
};

/// Memory of the caller's, which kernels only read: it is bound to what they declare as StructuredBuffer.
class BorrowedBuffer final : public CpuBuffer {
 public:
  BorrowedBuffer(std::span<const std::byte> memory, std::shared_ptr<Ledger> ledger)
      : CpuBuffer(const_cast<std::byte*>(memory.data()), memory.size(), std::move(ledger)) {}
};

/// What slangc's C++ takes: a range of groups, end exclusive in each dimension.
struct GroupRange {
  std::uint32_t start[3], end[3];
};
using Entry = void (*)(GroupRange*, void* entryPointParams, void* globalParams);

class CpuKernel final : public Kernel {
 public:
  explicit CpuKernel(const CompiledKernel& compiled)
      : compiled_(compiled), description_(devices::describe(compiled, "cpu")) {
    if (compiled.route != Route::kCpp) fail(fmt::format("cpu: kernel {} was not compiled for a CPU", compiled.stage));
    library_ = dlopen(compiled.binary.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library_ == nullptr) fail(fmt::format("cpu: kernel {} cannot be loaded: {}", compiled.stage, dlerror()));
    entry_ = reinterpret_cast<Entry>(dlsym(library_, compiled.entry.c_str()));
    if (entry_ == nullptr) {
      dlclose(library_);
      fail(fmt::format("cpu: kernel {}: {} has no entry point {}", compiled.stage, compiled.binary.string(),
                       compiled.entry));
    }
  }
  ~CpuKernel() override { dlclose(library_); }
  CpuKernel(const CpuKernel&) = delete;

  const CompiledKernel& compiled() const override { return compiled_; }
  /// As messages call it.
  const char* description() const { return description_.c_str(); }

  /// Linear groups [begin, end): one call for each row of groups that they touch.
  void run(std::uint32_t begin, std::uint32_t end, void* globals) const {
    for (std::uint32_t at = begin; at < end;) {
      const std::uint32_t row = at / kGroupRow, first = at % kGroupRow, count = std::min(end - at, kGroupRow - first);
      GroupRange range{{first, row, 0}, {first + count, row + 1, 1}};
      entry_(&range, nullptr, globals);
      at += count;
    }
  }

 private:
  CompiledKernel compiled_;
  std::string description_;
  void* library_ = nullptr;
  Entry entry_ = nullptr;
};

const CpuBuffer& own(const Buffer& buffer) {
  const auto* cpu = dynamic_cast<const CpuBuffer*>(&buffer);
  if (cpu == nullptr) fail("cpu: a buffer of another device");
  return *cpu;
}

std::byte* slice(const Buffer& buffer, std::size_t offset, std::size_t bytes, const char* what) {
  const CpuBuffer& cpu = own(buffer);
  if (offset > cpu.bytes() || bytes > cpu.bytes() - offset)
    fail(fmt::format("cpu: {} of {} bytes at {} of a buffer of {} bytes", what, bytes, offset, cpu.bytes()));
  return cpu.data() + offset;
}

void refuseBorrowed(const Buffer& buffer) {
  if (dynamic_cast<const BorrowedBuffer*>(&buffer) != nullptr) fail("cpu: borrowed memory is read only");
}

std::uint64_t nowNs() {
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
          .count());
}

class CpuDevice final : public Device {
 public:
  explicit CpuDevice(const CpuOptions& options)
      : shuffleSeed_(options.shuffleSeed),
        crew_(options.plainThreads || kPlainThreads ? devices::cpu::makePlainCrew(options.threads)
                                                    : devices::cpu::makeTbbCrew(options.threads)) {
    const DeviceKind kind = devices::cpuKind();
    info_.api = kind.name;
    info_.routes = kind.routes;
    info_.name = support::processorName();
    info_.driver = kernels::cpuDriverText();
    info_.threads = crew_->threads();
    info_.maxGroupBytes = axes::kThreadGroupBytes;
    info_.timeClock = "wall";
  }

  const DeviceInfo& info() const override { return info_; }

  std::unique_ptr<Buffer> createBuffer(std::size_t bytes, std::string_view name) override {
    return std::make_unique<OwnedBuffer>(bytes, name, ledger_);
  }
  std::unique_ptr<Buffer> borrow(std::span<const std::byte> memory, std::string_view) override {
    return std::make_unique<BorrowedBuffer>(memory, ledger_);
  }
  std::unique_ptr<Kernel> createKernel(const CompiledKernel& kernel) override {
    return std::make_unique<CpuKernel>(kernel);
  }

  void write(Buffer& buffer, std::size_t offset, std::span<const std::byte> data) override {
    refuseBorrowed(buffer);
    std::copy(data.begin(), data.end(), slice(buffer, offset, data.size(), "write"));
  }
  void read(const Buffer& buffer, std::size_t offset, std::span<std::byte> data) override {
    const std::byte* from = slice(buffer, offset, data.size(), "read");
    std::copy(from, from + data.size(), data.begin());
  }
  void fill(Buffer& buffer, std::size_t offset, std::size_t bytes, std::uint32_t value) override {
    if (bytes % 4 != 0 || offset % 4 != 0)
      fail(fmt::format("cpu: fill of {} bytes at {}: both are multiples of 4", bytes, offset));
    refuseBorrowed(buffer);
    auto* words = reinterpret_cast<std::uint32_t*>(slice(buffer, offset, bytes, "fill"));
    const std::size_t count = bytes / 4, piece = kFillPiece / 4;
    devices::cpu::spread(*crew_, static_cast<std::uint32_t>((count + piece - 1) / piece),
                         [&](std::uint32_t begin, std::uint32_t end) {
                           std::fill(words + begin * piece, words + std::min(count, end * piece), value);
                         });
  }

  void dispatch(const Kernel& kernel, std::span<const Binding> bindings, std::span<const std::byte> block,
                std::uint32_t groups) override {
    const auto* cpu = dynamic_cast<const CpuKernel*>(&kernel);
    if (cpu == nullptr) fail("cpu: a kernel of another device");
    if (groups == 0) return;
    alignas(kCacheLine) std::byte globals[kMaxGlobals], frame[kMaxBlock];
    fillGlobals(cpu->compiled(), bindings, block, globals, frame);
    const std::uint64_t begin = nowNs();
    try {
      const devices::RunningKernel running(cpu->description());
      if (shuffleSeed_ == 0)
        devices::cpu::spread(*crew_, groups,
                             [&](std::uint32_t first, std::uint32_t last) { cpu->run(first, last, globals); });
      else
        runShuffled(*cpu, groups, globals);
    } catch (const std::out_of_range& error) {  // Slang's bounds checks, where they are compiled in
      explain(*cpu, bindings, error.what());
    }
    times_.push_back({cpu->compiled().stage, begin, nowNs()});
  }

  void finish() override {}
  std::vector<StageTime> takeTimes() override { return std::exchange(times_, {}); }
  std::uint64_t peakBufferBytes() const override { return ledger_->peak; }

 private:
  static constexpr std::size_t kMaxGlobals = 1024, kMaxBlock = 4096;

  /// `numbers` are those that host/kernels/slang-compiler.cpp has the check throw.
  [[noreturn]] static void explain(const CpuKernel& kernel, std::span<const Binding> bindings,
                                   const std::string& numbers) {
    long long index = 0;
    std::size_t count = 0, address = 0;
    std::istringstream(numbers) >> index >> count >> address;
    const auto holder = std::ranges::find_if(bindings, [&](const Binding& b) {
      return address != 0 && b.buffer != nullptr && own(*b.buffer).data() == reinterpret_cast<std::byte*>(address);
    });
    const std::string what =
        holder == bindings.end() ? std::string("an array in it") : fmt::format("`{}`", holder->name);
    devices::failOutOfBounds(kernel.compiled(), "cpu", index, count, what);
  }

  /// The struct of globals: a pointer to the block, and a pointer and an element count for each structured buffer.
  static void fillGlobals(const CompiledKernel& kernel, std::span<const Binding> bindings,
                          std::span<const std::byte> block, std::byte* globals, std::byte* frame) {
    const KernelInterface& interface = kernel.interface;
    if (interface.globalsSize > kMaxGlobals || interface.blockSize > kMaxBlock)
      fail(fmt::format("cpu: kernel {}: {} bytes of globals and {} of `frame` are beyond {} and {}", kernel.stage,
                       interface.globalsSize, interface.blockSize, kMaxGlobals, kMaxBlock));
    if (block.size() < interface.blockSize)
      fail(fmt::format("cpu: kernel {}: `frame` has {} bytes, {} were given", kernel.stage, interface.blockSize,
                       block.size()));
    std::copy_n(block.begin(), interface.blockSize, frame);
    std::memset(globals, 0, interface.globalsSize);
    const auto put = [&](std::uint32_t offset, const void* pointer, std::uint64_t count, std::size_t bytes) {
      const struct {
        const void* pointer;
        std::uint64_t count;
      } value{pointer, count};
      std::memcpy(globals + offset, &value, bytes);
    };
    for (const auto& [name, offset] : interface.resources) {
      if (name == "frame") {
        put(offset, frame, 0, sizeof(void*));
        continue;
      }
      const auto bound = std::find_if(bindings.begin(), bindings.end(),
                                      [&](const Binding& b) { return b.name == name && b.buffer != nullptr; });
      if (bound == bindings.end()) fail(fmt::format("cpu: kernel {}: nothing is bound to `{}`", kernel.stage, name));
      const CpuBuffer& buffer = own(*bound->buffer);
      put(offset, buffer.data(), buffer.bytes() / interface.elementSizes.at(name), 16);
    }
  }

  /// Group by group in an order that the seed and the number of the dispatch give; with one thread that very order,
  /// replayable.
  void runShuffled(const CpuKernel& kernel, std::uint32_t groups, void* globals) {
    std::vector<std::uint32_t> order(groups);
    std::iota(order.begin(), order.end(), 0u);
    std::mt19937_64 random(shuffleSeed_ + 0x9e3779b97f4a7c15u * ++dispatches_);
    for (std::uint32_t i = groups; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    devices::cpu::spread(*crew_, groups, [&](std::uint32_t first, std::uint32_t last) {
      for (std::uint32_t i = first; i < last; ++i) kernel.run(order[i], order[i] + 1, globals);
    });
  }

  DeviceInfo info_;
  std::uint64_t shuffleSeed_, dispatches_ = 0;
  std::unique_ptr<devices::cpu::Crew> crew_;
  std::shared_ptr<Ledger> ledger_ = std::make_shared<Ledger>();
  std::vector<StageTime> times_;
};

}  // namespace

std::unique_ptr<Device> makeCpuDevice(const CpuOptions& options) { return std::make_unique<CpuDevice>(options); }

}  // namespace tessera
