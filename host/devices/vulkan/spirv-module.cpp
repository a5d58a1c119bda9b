#include "host/devices/vulkan/spirv-module.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <cstring>
#include <map>
#include <span>
#include <spirv/unified1/spirv.hpp>

#include "host/kernels/spirv.h"

namespace tessera::devices::vulkan {
namespace {

constexpr std::size_t kHeaderWords = 5;

/// Types and constants seen so far: enough to size group-shared variables.
struct Sizes {
  std::map<std::uint32_t, std::uint32_t> bytes, constants, pointees;

  void see(spv::Op op, std::span<const std::uint32_t> w) {
    switch (op) {
      case spv::OpTypeBool:
        bytes[w[1]] = 4;
        break;
      case spv::OpTypeInt:
      case spv::OpTypeFloat:
        bytes[w[1]] = w[2] / 8;
        break;
      case spv::OpTypeVector:
      case spv::OpTypeMatrix:
        bytes[w[1]] = bytes[w[2]] * w[3];
        break;
      case spv::OpTypeArray:
        bytes[w[1]] = bytes[w[2]] * constants[w[3]];
        break;
      case spv::OpTypeStruct:
        for (std::uint32_t member : w.subspan(2)) bytes[w[1]] += bytes[member];
        break;
      case spv::OpTypePointer:
        pointees[w[1]] = w[3];
        break;
      case spv::OpConstant:
        constants[w[2]] = w[3];
        break;
      default:
        break;
    }
  }
};

}  // namespace

SpirvModule readModule(const std::filesystem::path& path) {
  const std::vector<std::uint32_t> source = kernels::readSpirv(path);
  SpirvModule module;
  module.words.assign(source.begin(), source.begin() + kHeaderWords);
  Sizes sizes;
  unsigned entries = 0;
  for (std::size_t at = kHeaderWords; at < source.size();) {
    const std::uint32_t count = source[at] >> 16;
    const auto op = static_cast<spv::Op>(source[at] & 0xffff);
    if (count == 0 || at + count > source.size()) fail(fmt::format("{}: broken at word {}", path.string(), at));
    const std::span words(source.data() + at, count);
    at += count;
    // Debian 12's validation layer does not know the language number that slangc writes here; nothing refers to it.
    if (op == spv::OpSource) continue;
    module.words.insert(module.words.end(), words.begin(), words.end());
    sizes.see(op, words);
    if (op == spv::OpCapability) module.capabilities.push_back(words[1]);
    if (op == spv::OpEntryPoint && words[1] == spv::ExecutionModelGLCompute) {
      ++entries;
      const char* name = reinterpret_cast<const char*>(&words[3]);
      module.entry.assign(name, strnlen(name, (count - 3) * 4));
    }
    if (op == spv::OpExecutionMode && words[2] == spv::ExecutionModeLocalSize)
      module.localSize = {words[3], words[4], words[5]};
    if (op == spv::OpVariable && words[3] == spv::StorageClassWorkgroup)
      module.groupMemoryBytes += sizes.bytes[sizes.pointees[words[1]]];
  }
  if (entries != 1) fail(fmt::format("{}: {} compute entry points, there should be 1", path.string(), entries));
  return module;
}

}  // namespace tessera::devices::vulkan
