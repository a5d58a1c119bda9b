#include "host/kernels/spirv-reflection.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <map>
#include <optional>
#include <set>
#include <spirv/unified1/spirv.hpp>
#include <string>
#include <utility>

#include "host/kernels/spirv.h"

namespace tessera::kernels {
namespace {

using Id = std::uint32_t;

/// What stands in a module ahead of its functions.
struct Declarations {
  std::map<Id, std::string> names;
  std::map<std::pair<Id, std::uint32_t>, std::string> memberNames;
  std::map<Id, SpirvInstruction> types;
  std::map<Id, std::uint32_t> constants;
  std::vector<SpirvInstruction> variables;
  std::map<std::pair<Id, std::uint32_t>, std::uint32_t> decorations;                       // (id, decoration) -> value
  std::map<std::pair<Id, std::uint32_t>, std::map<std::uint32_t, std::uint32_t>> members;  // (struct, member) -> these
  std::array<std::uint32_t, 3> groupSize{1, 1, 1};
  unsigned entries = 0;

  explicit Declarations(const std::vector<std::uint32_t>& words) {
    for (const SpirvInstruction& i : spirvInstructions(words)) see(i);
  }

  void see(const SpirvInstruction& i) {
    const std::uint32_t* o = i.operands;
    switch (i.op) {
      case spv::OpName:
        names[o[0]] = i.text(1);
        break;
      case spv::OpMemberName:
        memberNames[{o[0], o[1]}] = i.text(2);
        break;
      case spv::OpEntryPoint:
        entries += o[0] == spv::ExecutionModelGLCompute;
        break;
      case spv::OpExecutionMode:
        if (o[1] == spv::ExecutionModeLocalSize) groupSize = {o[2], o[3], o[4]};
        break;
      case spv::OpConstant:
        constants[o[1]] = o[2];
        break;
      case spv::OpVariable:
        variables.push_back(i);
        break;
      case spv::OpDecorate:
        decorations[{o[0], o[1]}] = i.count > 2 ? o[2] : 0;
        break;
      case spv::OpMemberDecorate:
        members[{o[0], o[1]}][o[2]] = i.count > 3 ? o[3] : 0;
        break;
      default:
        if (i.op >= spv::OpTypeInt && i.op <= spv::OpTypePointer && i.count > 0) types.emplace(o[0], i);
    }
  }

  std::optional<std::uint32_t> decoration(Id id, std::uint32_t which) const {
    const auto found = decorations.find({id, which});
    return found == decorations.end() ? std::nullopt : std::optional(found->second);
  }
  std::optional<std::uint32_t> memberDecoration(Id type, std::uint32_t member, std::uint32_t which) const {
    const auto found = members.find({type, member});
    if (found == members.end() || !found->second.contains(which)) return {};
    return found->second.at(which);
  }
  std::string name(Id id) const {
    const auto found = names.find(id);
    return found == names.end() ? "" : found->second;
  }
  std::string memberName(Id type, std::uint32_t member) const {
    const auto found = memberNames.find({type, member});
    return found == memberNames.end() ? "" : found->second;
  }

  /// Bytes of a scalar, vector, matrix or array of a uniform block, without the padding after it.
  std::uint32_t bytes(Id type) const {
    const SpirvInstruction& t = types.at(type);
    const std::uint32_t* o = t.operands;
    if (t.op == spv::OpTypeInt || t.op == spv::OpTypeFloat) return o[1] / 8;
    if (t.op == spv::OpTypeVector || t.op == spv::OpTypeMatrix) return bytes(o[1]) * o[2];
    if (t.op == spv::OpTypeArray) return decoration(type, spv::DecorationArrayStride).value_or(0) * constants.at(o[2]);
    std::uint32_t end = 0;
    if (t.op == spv::OpTypeStruct)
      for (std::uint32_t m = 0; m + 1 < t.count; ++m)
        end = std::max(end, memberDecoration(type, m, spv::DecorationOffset).value_or(0) + bytes(o[m + 1]));
    return end;
  }
};

class Reader {
 public:
  explicit Reader(const std::vector<std::uint32_t>& words) : module_(words) {}

  KernelInterface read() {
    if (module_.entries != 1) failUsage(fmt::format("{} compute entry points; a kernel has one", module_.entries));
    interface_.groupSize = module_.groupSize;
    for (const SpirvInstruction& variable : module_.variables) readVariable(variable);
    return std::move(interface_);
  }

 private:
  void readVariable(const SpirvInstruction& variable) {  // result type, result, storage class
    const Id id = variable.operands[1];
    const std::uint32_t storage = variable.operands[2];
    if (storage == spv::StorageClassInput || storage == spv::StorageClassPrivate ||
        storage == spv::StorageClassWorkgroup || storage == spv::StorageClassFunction)
      return;
    const Id type = module_.types.at(variable.operands[0]).operands[2];
    const bool isStruct = module_.types.at(type).op == spv::OpTypeStruct;
    const bool isStorage =
        storage == spv::StorageClassStorageBuffer || module_.decoration(type, spv::DecorationBufferBlock);
    if (!isStruct || (!isStorage && storage != spv::StorageClassUniform))
      failUsage(fmt::format("`{}` is neither a storage buffer nor the uniform block `frame`", module_.name(id)));
    const std::string name = isStorage ? readStorage(id, type) : readBlock(id, type);
    if (const auto set = module_.decoration(id, spv::DecorationDescriptorSet).value_or(0); set != 0)
      failUsage(fmt::format("`{}` is in descriptor set {}; Tessera binds set 0 only", name, set));
    const auto binding = module_.decoration(id, spv::DecorationBinding);
    if (!binding) failUsage(fmt::format("`{}` has no binding; layout(binding = N) gives it one", name));
    for (const auto& [other, place] : interface_.resources)
      if (place == *binding) failUsage(fmt::format("`{}` and `{}` have binding {} both", other, name, place));
    if (!interface_.resources.emplace(name, *binding).second) failUsage(fmt::format("`{}` is there twice", name));
  }

  std::string readStorage(Id id, Id type) {
    const SpirvInstruction& block = module_.types.at(type);
    const Id element = block.count == 2 ? block.operands[1] : 0;
    const std::string name = module_.name(id).empty() ? module_.memberName(type, 0) : module_.name(id);
    if (element == 0 || module_.types.at(element).op != spv::OpTypeRuntimeArray)
      failUsage(fmt::format("storage block `{}`: one array without a length, and nothing else, is what a buffer holds",
                            name.empty() ? module_.name(type) : name));
    interface_.elementSizes[name] = module_.decoration(element, spv::DecorationArrayStride).value_or(0);
    if (!module_.memberDecoration(type, 0, spv::DecorationNonWritable) &&
        !module_.decoration(id, spv::DecorationNonWritable))
      interface_.writable.insert(name);
    return name;
  }

  std::string readBlock(Id id, Id type) {
    const std::string name = module_.name(id).empty() ? module_.name(type) : module_.name(id);
    if (name != "frame") failUsage(fmt::format("uniform block `{}`: a kernel has one, named `frame`", name));
    const SpirvInstruction& block = module_.types.at(type);
    for (std::uint32_t m = 0; m + 1 < block.count; ++m) {
      const Id field = block.operands[m + 1];
      interface_.fields[module_.memberName(type, m)] = {
          module_.memberDecoration(type, m, spv::DecorationOffset).value_or(0), module_.bytes(field),
          module_.types.at(field).op == spv::OpTypeFloat};
    }
    interface_.blockSize = (module_.bytes(type) + 15) / 16 * 16;  // std140 rounds the block up
    return name;
  }

  Declarations module_;
  KernelInterface interface_;
};

}  // namespace

KernelInterface readSpirvInterface(const std::vector<std::uint32_t>& words) { return Reader(words).read(); }

}  // namespace tessera::kernels
