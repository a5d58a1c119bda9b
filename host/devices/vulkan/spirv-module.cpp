#include "host/devices/vulkan/spirv-module.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <cstring>
#include <map>
#include <span>

#include "host/kernels/spirv.h"

namespace tessera::vulkan {
namespace {

// Numbers of the SPIR-V specification, section 3.
enum Op : std::uint32_t {
  kOpSource = 3,
  kOpEntryPoint = 15,
  kOpExecutionMode = 16,
  kOpCapability = 17,
  kOpTypeBool = 20,
  kOpTypeInt = 21,
  kOpTypeFloat = 22,
  kOpTypeVector = 23,
  kOpTypeMatrix = 24,
  kOpTypeArray = 28,
  kOpTypeStruct = 30,
  kOpTypePointer = 32,
  kOpConstant = 43,
  kOpVariable = 59
};
constexpr std::uint32_t kGLCompute = 5, kLocalSize = 17, kWorkgroup = 4;
constexpr std::size_t kHeaderWords = 5;

/// Types and constants seen so far: enough to size group-shared variables.
struct Sizes {
  std::map<std::uint32_t, std::uint32_t> bytes, constants, pointees;

  void see(Op op, std::span<const std::uint32_t> w) {
    switch (op) {
      case kOpTypeBool:
        bytes[w[1]] = 4;
        break;
      case kOpTypeInt:
      case kOpTypeFloat:
        bytes[w[1]] = w[2] / 8;
        break;
      case kOpTypeVector:
      case kOpTypeMatrix:
        bytes[w[1]] = bytes[w[2]] * w[3];
        break;
      case kOpTypeArray:
        bytes[w[1]] = bytes[w[2]] * constants[w[3]];
        break;
      case kOpTypeStruct:
        for (std::uint32_t member : w.subspan(2)) bytes[w[1]] += bytes[member];
        break;
      case kOpTypePointer:
        pointees[w[1]] = w[3];
        break;
      case kOpConstant:
        constants[w[2]] = w[3];
        break;
      default:
        break;
    }
  }
};

}  // namespace

SpirvModule readModule(const std::filesystem::path& path) {
  const std::vector<std::uint32_t> source = readSpirv(path);
  SpirvModule module;
  module.words.assign(source.begin(), source.begin() + kHeaderWords);
  Sizes sizes;
  unsigned entries = 0;
  for (std::size_t at = kHeaderWords; at < source.size();) {
    const std::uint32_t count = source[at] >> 16;
    const Op op = static_cast<Op>(source[at] & 0xffff);
    if (count == 0 || at + count > source.size()) fail(fmt::format("{}: broken at word {}", path.string(), at));
    const std::span words(source.data() + at, count);
    at += count;
    // Debian 12's validation layer does not know the language number that slangc writes here; nothing refers to it.
    if (op == kOpSource) continue;
    module.words.insert(module.words.end(), words.begin(), words.end());
    sizes.see(op, words);
    if (op == kOpCapability) module.capabilities.push_back(words[1]);
    if (op == kOpEntryPoint && words[1] == kGLCompute) {
      ++entries;
      const char* name = reinterpret_cast<const char*>(&words[3]);
      module.entry.assign(name, strnlen(name, (count - 3) * 4));
    }
    if (op == kOpExecutionMode && words[2] == kLocalSize) module.localSize = {words[3], words[4], words[5]};
    if (op == kOpVariable && words[3] == kWorkgroup) module.groupMemoryBytes += sizes.bytes[sizes.pointees[words[1]]];
  }
  if (entries != 1) fail(fmt::format("{}: {} compute entry points, there should be 1", path.string(), entries));
  return module;
}

}  // namespace tessera::vulkan
