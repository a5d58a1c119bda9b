#include "host/kernels/spirv.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>
#include <fstream>

#include "host/support/files.h"

namespace tessera::kernels {
namespace {

constexpr std::size_t kHeaderWords = 5;

}  // namespace

std::string SpirvInstruction::text(std::size_t from) const {
  const char* begin = reinterpret_cast<const char*>(operands + from);
  return {begin, std::find(begin, begin + (count - from) * 4, '\0')};
}

std::vector<SpirvInstruction> spirvInstructions(const std::vector<std::uint32_t>& words) {
  std::vector<SpirvInstruction> all;
  for (std::size_t at = kHeaderWords; at < words.size();) {
    const std::size_t length = words[at] >> 16;
    if (length == 0 || at + length > words.size())
      fail(fmt::format("SPIR-V word {}: an instruction of {} words does not fit", at, length));
    all.push_back({words[at] & 0xffff, words.data() + at + 1, length - 1, at});
    at += length;
  }
  return all;
}

std::vector<std::uint32_t> readSpirv(const std::filesystem::path& module) {
  std::ifstream file(module, std::ios::binary | std::ios::ate);
  if (!file) fail(fmt::format("{}: cannot be read", module.string()));
  const auto bytes = static_cast<std::size_t>(file.tellg());
  std::vector<std::uint32_t> words(bytes / 4);
  file.seekg(0);
  file.read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(words.size() * 4));
  if (!file || bytes % 4 != 0 || words.size() < kHeaderWords || words[0] != 0x07230203u)
    fail(fmt::format("{}: not a SPIR-V module", module.string()));
  return words;
}

void writeSpirv(const std::filesystem::path& module, const std::vector<std::uint32_t>& words) {
  support::writeInto(module, {reinterpret_cast<const char*>(words.data()), words.size() * 4});
}

}  // namespace tessera::kernels
