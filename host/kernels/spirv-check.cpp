#include <fmt/format.h>
#include <tessera/kernel-cache.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <spirv/unified1/spirv.hpp>

#include "host/kernels/spirv.h"

namespace tessera {
namespace {

/// Instructions that a driver may fuse with a neighbour unless NoContraction stands on them.
const std::map<std::uint32_t, const char*> kContractible = {{spv::OpFAdd, "OpFAdd"},
                                                            {spv::OpFSub, "OpFSub"},
                                                            {spv::OpFMul, "OpFMul"},
                                                            {spv::OpFDiv, "OpFDiv"},
                                                            {spv::OpVectorTimesScalar, "OpVectorTimesScalar"}};

/// Instructions whose order of operations, or rounding, is the driver's.
const std::map<std::uint32_t, const char*> kForbidden = {{spv::OpFRem, "OpFRem"},
                                                         {spv::OpFMod, "OpFMod"},
                                                         {spv::OpMatrixTimesScalar, "OpMatrixTimesScalar"},
                                                         {spv::OpVectorTimesMatrix, "OpVectorTimesMatrix"},
                                                         {spv::OpMatrixTimesVector, "OpMatrixTimesVector"},
                                                         {spv::OpMatrixTimesMatrix, "OpMatrixTimesMatrix"},
                                                         {spv::OpOuterProduct, "OpOuterProduct"},
                                                         {spv::OpDot, "OpDot"}};

/// GLSL.std.450 instructions with one right result for every input: Trunc, FAbs, SAbs, FSign, SSign, Floor, Ceil, Sqrt
/// (judged by the probe), UMin, SMin, UMax, SMax, UClamp, SClamp, FindILsb, FindSMsb, FindUMsb. All else is reported:
/// FMin and FMax choose freely between a number and NaN, and between the two zeros.
const std::set<std::uint32_t> kExactExtended = {3, 4, 5, 6, 7, 8, 9, 31, 38, 39, 41, 42, 44, 45, 73, 74, 75};
const std::map<std::uint32_t, const char*> kExtendedNames = {
    {1, "Round"},  {2, "RoundEven"},  {10, "Fract"},       {26, "Pow"},  {27, "Exp"},    {28, "Log"},
    {29, "Exp2"},  {30, "Log2"},      {32, "InverseSqrt"}, {37, "FMin"}, {40, "FMax"},   {43, "FClamp"},
    {46, "FMix"},  {48, "Step"},      {49, "SmoothStep"},  {50, "Fma"},  {66, "Length"}, {67, "Distance"},
    {68, "Cross"}, {69, "Normalize"}, {79, "NMin"},        {80, "NMax"}, {81, "NClamp"}};

bool isNoContraction(const kernels::SpirvInstruction& i) {
  return i.op == spv::OpDecorate && i.count >= 2 && i.operands[1] == spv::DecorationNoContraction;
}

}  // namespace

namespace kernels {

std::vector<std::string> checkSpirv(const std::vector<std::uint32_t>& words) {
  const std::vector<SpirvInstruction> all = spirvInstructions(words);
  std::map<std::uint32_t, std::string> names;
  std::set<std::uint32_t> decorated, glslSets;
  for (const SpirvInstruction& i : all) {
    if (isNoContraction(i)) decorated.insert(i.operands[0]);
    if (i.op == spv::OpName && i.count >= 2) names[i.operands[0]] = i.text(1);
    if (i.op == spv::OpExtInstImport && i.count >= 2 && i.text(1) == "GLSL.std.450") glslSets.insert(i.operands[0]);
  }
  std::vector<std::string> violations;
  const auto report = [&](const SpirvInstruction& i,
                          const std::string& what) {  // operands are: result type, result, ...
    const auto name = names.find(i.operands[1]);
    violations.push_back(fmt::format("word {}: {} %{}{}", i.at, what, i.operands[1],
                                     name == names.end() ? "" : " (" + name->second + ")"));
  };
  for (const SpirvInstruction& i : all) {
    if (i.count < 2) continue;
    if (const auto op = kContractible.find(i.op); op != kContractible.end() && !decorated.count(i.operands[1]))
      report(i, fmt::format("{} without NoContraction", op->second));
    if (const auto op = kForbidden.find(i.op); op != kForbidden.end()) report(i, op->second);
    if (i.op == spv::OpExtInst && i.count >= 4 && glslSets.count(i.operands[2]) &&
        !kExactExtended.count(i.operands[3])) {
      const auto name = kExtendedNames.find(i.operands[3]);
      report(i,
             name != kExtendedNames.end() ? name->second : fmt::format("GLSL.std.450 instruction {}", i.operands[3]));
    }
  }
  return violations;
}

}  // namespace kernels

std::vector<std::string> checkSpirv(const std::filesystem::path& module) {
  return kernels::checkSpirv(kernels::readSpirv(module));
}

namespace kernels {

void decorateNoContraction(std::vector<std::uint32_t>& words) {
  const std::vector<SpirvInstruction> all = spirvInstructions(words);
  std::set<std::uint32_t> decorated;
  for (const SpirvInstruction& i : all)
    if (isNoContraction(i)) decorated.insert(i.operands[0]);
  std::vector<std::uint32_t> added;
  for (const SpirvInstruction& i : all)
    if (i.count >= 2 && kContractible.count(i.op) && !decorated.count(i.operands[1]))
      added.insert(added.end(), {(3u << 16) | spv::OpDecorate, i.operands[1], spv::DecorationNoContraction});
  // Annotations stand right before the types and constants (SPIR-V 2.4, logical layout).
  const auto types = std::find_if(all.begin(), all.end(), [](const SpirvInstruction& i) {
    return i.op >= spv::OpTypeVoid && i.op <= spv::OpTypeForwardPointer;
  });
  if (!added.empty() && types != all.end())
    words.insert(words.begin() + static_cast<std::ptrdiff_t>(types->at), added.begin(), added.end());
}

}  // namespace kernels

}  // namespace tessera
