// SPIR-V modules as words: what the contract forbids in one, and the one repair that the GLSL route needs.
// Numbers of GLSL.std.450 are those of its version 1.00.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tessera::kernels {

/// Throws kFailure unless the file is a module in this machine's byte order.
std::vector<std::uint32_t> readSpirv(const std::filesystem::path& module);
void writeSpirv(const std::filesystem::path& module, const std::vector<std::uint32_t>& words);

struct SpirvInstruction {
  std::uint32_t op;
  const std::uint32_t* operands;  ///< the words after the first
  std::size_t count;              ///< of operands
  std::size_t at;                 ///< index of the first word

  std::string text(std::size_t from) const;  ///< a literal string among the operands
};
/// They point into `words`. Throws kFailure where one does not fit.
std::vector<SpirvInstruction> spirvInstructions(const std::vector<std::uint32_t>& words);

/// checkSpirv() of kernel-cache.h, on words.
std::vector<std::string> checkSpirv(const std::vector<std::uint32_t>& words);

/// Adds NoContraction to every float sum, difference, product and quotient that lacks it. glslang keeps them apart but
/// writes the decoration only for what GLSL calls `precise`, which is a quality of variables: an expression that goes
/// straight into a buffer or a comparison has none to put it on. So it is put on the instructions, where the driver
/// reads it. No instruction changes.
void decorateNoContraction(std::vector<std::uint32_t>& words);

}  // namespace tessera::kernels
