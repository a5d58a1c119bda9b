#include "host/kernels/spirv-bounds.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <utility>

#define SPV_ENABLE_UTILITY_CODE
#include <spirv/unified1/spirv.hpp>

#include "host/kernels/spirv.h"

namespace tessera::kernels {
namespace {

using Id = std::uint32_t;
using Words = std::vector<std::uint32_t>;

constexpr std::size_t kHeaderWords = 5, kVersionWord = 1, kBoundWord = 3;
constexpr std::uint32_t kVersion13 = 0x10300, kVersion14 = 0x10400;
constexpr std::size_t kFirstIndex = 3;  // of the operands of an access chain, after its type, its id and its base

/// What a module needs for pointers that lead elsewhere than into one variable.
constexpr std::array<std::uint32_t, 4> kAddresses{
    spv::CapabilityAddresses, spv::CapabilityVariablePointersStorageBuffer, spv::CapabilityVariablePointers,
    spv::CapabilityPhysicalStorageBufferAddresses};

void put(Words& to, spv::Op op, std::initializer_list<std::uint32_t> operands) {
  to.push_back(static_cast<std::uint32_t>(operands.size() + 1) << 16 | op);
  to.insert(to.end(), operands);
}

bool isChain(std::uint32_t op) { return op == spv::OpAccessChain || op == spv::OpInBoundsAccessChain; }

/// What the module says of its ids.
struct Module {
  std::map<Id, SpirvInstruction> made;  ///< by its result
  std::map<Id, Id> types;               ///< of results that have one
  std::map<Id, std::string> names;
  std::map<Id, std::uint32_t> bindings;

  explicit Module(const std::vector<SpirvInstruction>& all) {
    for (const SpirvInstruction& i : all) {
      bool hasResult = false, hasType = false;
      spv::HasResultAndType(static_cast<spv::Op>(i.op), &hasResult, &hasType);
      if (hasResult) made.emplace(i.operands[hasType ? 1 : 0], i);
      if (hasResult && hasType) types.emplace(i.operands[1], i.operands[0]);
      if (i.op == spv::OpName) names[i.operands[0]] = i.text(1);
      if (i.op == spv::OpDecorate && i.operands[1] == spv::DecorationBinding) bindings[i.operands[0]] = i.operands[2];
    }
  }

  const SpirvInstruction& typeOf(Id id) const { return made.at(types.at(id)); }
  /// A type of these operands after its own id. Such types are in a module once.
  std::optional<Id> type(spv::Op op, std::initializer_list<std::uint32_t> operands) const {
    for (const auto& [id, i] : made)
      if (i.op == op && std::equal(i.operands + 1, i.operands + i.count, operands.begin(), operands.end())) return id;
    return {};
  }
  /// Of an integer constant of at most 32 bits; nobody sets specialization constants, so theirs is the one written.
  std::optional<std::uint32_t> constant(Id id) const {
    const SpirvInstruction& i = made.at(id);
    if (i.op == spv::OpConstantNull) return 0;
    if ((i.op == spv::OpConstant || i.op == spv::OpSpecConstant) && i.count == 3) return i.operands[2];
    return {};
  }
  /// What a pointer leads into: a variable or a function's parameter, where that is known.
  Id root(Id pointer) const {
    const SpirvInstruction& i = made.at(pointer);
    return isChain(i.op) || i.op == spv::OpCopyObject ? root(i.operands[2]) : pointer;
  }
};

class Checker {
 public:
  Checker(const Words& words, const std::map<std::string, std::uint32_t>& resources)
      : words_(words), all_(spirvInstructions(words)), module_(all_), next_(words[kBoundWord]) {
    if (words[kVersionWord] < kVersion13)
      fail("SPIR-V older than 1.3 has no storage class for the buffer that bounds checks need");
    for (const SpirvInstruction& i : all_)
      if (i.op == spv::OpCapability && std::ranges::find(kAddresses, i.operands[0]) != kAddresses.end())
        failUsage("it computes addresses, which bounds checks cannot follow; indices into buffers and arrays would do");
    for (const auto& [name, binding] : resources) names_[binding] = name;
    for (const auto& [id, binding] : module_.bindings) made_.binding = std::max(made_.binding, binding + 1);
    declare();
  }

  CheckedSpirv run() {
    const auto first = std::ranges::find(all_, std::uint32_t{spv::OpFunction}, &SpirvInstruction::op);
    for (auto i = first; i != all_.end(); ++i) rewrite(*i);
    if (!made_.accesses.empty()) defineCheck();
    Words& out = made_.words;
    out.assign(words_.begin(), words_.begin() + kHeaderWords);
    bool annotated = false;
    for (auto i = all_.begin(); i != first; ++i) {
      // Annotations stand right before the types and constants (SPIR-V 2.4, logical layout).
      if (i->op >= spv::OpTypeVoid && i->op <= spv::OpTypeForwardPointer && !std::exchange(annotated, true))
        out.insert(out.end(), annotations_.begin(), annotations_.end());
      copy(*i, out);
      if (i->op != spv::OpEntryPoint || words_[kVersionWord] < kVersion14) continue;
      out[out.size() - i->count - 1] += 1u << 16;  // from 1.4 on an entry point names all variables that it uses
      out.push_back(record_);
    }
    out.insert(out.end(), globals_.begin(), globals_.end());
    out.insert(out.end(), functions_.begin(), functions_.end());
    out[kBoundWord] = next_;
    return std::move(made_);
  }

 private:
  static void copy(const SpirvInstruction& i, Words& to) {
    to.push_back(static_cast<std::uint32_t>(i.count + 1) << 16 | i.op);
    to.insert(to.end(), i.operands, i.operands + i.count);
  }

  /// The type that is there, else a new one.
  Id typeOf(spv::Op op, std::initializer_list<std::uint32_t> operands) {
    if (const auto there = module_.type(op, operands)) return *there;
    const Id id = next_++;
    globals_.push_back(static_cast<std::uint32_t>(operands.size() + 2) << 16 | op);
    globals_.push_back(id);
    globals_.insert(globals_.end(), operands);
    return id;
  }

  Id constant(std::uint32_t value) {
    const auto [entry, isNew] = constants_.try_emplace(value, next_);
    if (isNew) put(globals_, spv::OpConstant, {uint_, next_++, value});
    return entry->second;
  }

  /// Types, and the buffer of the record.
  void declare() {
    uint_ = typeOf(spv::OpTypeInt, {32, 0});
    bool_ = typeOf(spv::OpTypeBool, {});
    checkType_ = typeOf(spv::OpTypeFunction, {uint_, uint_, uint_, uint_, uint_});
    check_ = next_++;
    const Id array = next_++, block = next_++, pointer = next_++;
    wordPointer_ = next_++;
    record_ = next_++;
    put(globals_, spv::OpTypeRuntimeArray, {array, uint_});
    put(globals_, spv::OpTypeStruct, {block, array});
    put(globals_, spv::OpTypePointer, {pointer, spv::StorageClassStorageBuffer, block});
    put(globals_, spv::OpTypePointer, {wordPointer_, spv::StorageClassStorageBuffer, uint_});
    put(globals_, spv::OpVariable, {pointer, record_, spv::StorageClassStorageBuffer});
    put(annotations_, spv::OpDecorate, {array, spv::DecorationArrayStride, 4});
    put(annotations_, spv::OpDecorate, {block, spv::DecorationBlock});
    put(annotations_, spv::OpMemberDecorate, {block, 0, spv::DecorationOffset, 0});
    put(annotations_, spv::OpDecorate, {record_, spv::DecorationDescriptorSet, 0});
    put(annotations_, spv::OpDecorate, {record_, spv::DecorationBinding, made_.binding});
  }

  void rewrite(const SpirvInstruction& i) {
    switch (i.op) {
      case spv::OpAccessChain:
      case spv::OpInBoundsAccessChain:
        rewriteChain(i);
        return;
      case spv::OpVectorExtractDynamic:  // type, id, vector, index
        rewriteComponent(i, 2, 3);
        return;
      case spv::OpVectorInsertDynamic:  // type, id, vector, component, index
        rewriteComponent(i, 2, 4);
        return;
      case spv::OpArrayLength:  // type, id, structure, member
        put(functions_, spv::OpLoad, {i.operands[0], i.operands[1], pointerTo(kFaultWords + placeOf(i.operands[2]))});
        return;
      default:
        copy(i, functions_);
    }
  }

  void rewriteComponent(const SpirvInstruction& i, std::size_t vector, std::size_t index) {
    const Length length{module_.typeOf(i.operands[vector]).operands[2], 0};
    const Id inside = checked(i.operands[index], length, "a vector in it");
    copy(i, functions_);
    functions_[functions_.size() - i.count + index] = inside;
  }

  void rewriteChain(const SpirvInstruction& i) {
    Words chain(i.operands, i.operands + i.count);
    const Id base = i.operands[2];
    const SpirvInstruction* type = &module_.made.at(module_.typeOf(base).operands[2]);
    for (std::size_t k = kFirstIndex; k < i.count; ++k) {
      if (type->op == spv::OpTypeStruct) {
        type = &module_.made.at(type->operands[1 + module_.constant(i.operands[k]).value()]);
        continue;
      }
      chain[k] = checked(i.operands[k], lengthOf(*type, base), nameOf(*type, base, k == kFirstIndex));
      type = &module_.made.at(type->operands[1]);
    }
    functions_.push_back(static_cast<std::uint32_t>(chain.size() + 1) << 16 | i.op);
    functions_.insert(functions_.end(), chain.begin(), chain.end());
  }

  /// Elements: a number, or an id where the module does not know it.
  struct Length {
    std::optional<std::uint32_t> known;
    Id id;
  };
  Length lengthOf(const SpirvInstruction& type, Id base) {
    switch (type.op) {
      case spv::OpTypeRuntimeArray:
        return {{}, wordAt(kFaultWords + placeOf(base))};
      case spv::OpTypeArray:
        if (const auto known = module_.constant(type.operands[2])) return {known, 0};
        return {{}, asWord(type.operands[2])};
      case spv::OpTypeVector:
      case spv::OpTypeMatrix:
        return {type.operands[2], 0};
      default:
        failUsage("it indexes what bounds checks do not know; buffers, arrays, vectors and matrices would do");
    }
  }

  std::string nameOf(const SpirvInstruction& type, Id base, bool first) const {
    const Id root = module_.root(base);
    const auto binding = module_.bindings.find(root);
    const auto buffer = binding == module_.bindings.end() ? names_.end() : names_.find(binding->second);
    const auto called = module_.names.find(root);
    std::string name = buffer != names_.end() ? buffer->second : called != module_.names.end() ? called->second : "";
    if (name == "indexable" || name.starts_with("_S")) name = "";  // the compilers' own: glslang's, slangc's in GLSL
    name = name.empty() ? "it" : fmt::format("`{}`", name);
    const bool isArray = type.op == spv::OpTypeArray || type.op == spv::OpTypeRuntimeArray;
    if (isArray && name != "it" && (type.op == spv::OpTypeRuntimeArray || (first && root == base))) return name;
    return fmt::format("{} in {}", isArray ? "an array" : type.op == spv::OpTypeVector ? "a vector" : "a matrix", name);
  }

  /// Of the storage buffer that a pointer leads into, among those whose lengths the host gives.
  std::uint32_t placeOf(Id pointer) {
    const auto binding = module_.bindings.find(module_.root(pointer));
    const auto name = binding == module_.bindings.end() ? names_.end() : names_.find(binding->second);
    if (name == names_.end())
      failUsage("it indexes a buffer that bounds checks cannot tell; one by its own name would do");
    auto& counted = made_.counted;
    const auto found = std::ranges::find(counted, name->second);
    const auto place = static_cast<std::uint32_t>(found - counted.begin());
    if (found == counted.end()) counted.push_back(name->second);
    return place;
  }

  /// The index, or 0 where it is out of range.
  Id checked(Id index, const Length& length, const std::string& what) {
    const auto known = module_.constant(index);
    if (known && length.known && *known < *length.known) return index;
    made_.accesses.push_back({what, isSigned(index), widthOf(index) > 32});
    const Id access = constant(static_cast<std::uint32_t>(made_.accesses.size()));
    const Id count = length.known ? constant(*length.known) : length.id, word = asWord(index), high = highWord(index),
             inside = next_++;
    put(functions_, spv::OpFunctionCall, {uint_, inside, check_, word, high, count, access});
    return inside;
  }

  /// Slang's GLSL casts all indices to unsigned.
  bool isSigned(Id index) const {
    const SpirvInstruction& i = module_.made.at(index);
    return module_.typeOf(index).operands[2] != 0 || (i.op == spv::OpBitcast && isSigned(i.operands[2]));
  }

  std::uint32_t widthOf(Id value) const { return module_.typeOf(value).operands[1]; }

  /// An integer of any type as an unsigned one of 32 bits, of 64 the lower ones.
  Id asWord(Id value) {
    const bool isUnsigned = module_.typeOf(value).operands[2] == 0;
    const std::uint32_t width = widthOf(value);
    if (width == 32 && isUnsigned) return value;
    const Id word = next_++;
    put(functions_,
        width == 32                ? spv::OpBitcast
        : width > 32 || isUnsigned ? spv::OpUConvert
                                   : spv::OpSConvert,
        {uint_, word, value});
    return word;
  }
  Id highWord(Id value) {
    if (widthOf(value) <= 32) return constant(0);
    const Id shifted = next_++, word = next_++;
    put(functions_, spv::OpShiftRightLogical, {module_.types.at(value), shifted, value, constant(32)});
    put(functions_, spv::OpUConvert, {uint_, word, shifted});
    return word;
  }

  Id pointerTo(std::uint32_t word) {
    const Id zero = constant(0), at = constant(word), pointer = next_++;
    put(functions_, spv::OpAccessChain, {wordPointer_, pointer, record_, zero, at});
    return pointer;
  }
  Id wordAt(std::uint32_t word) {
    const Id pointer = pointerTo(word), value = next_++;
    put(functions_, spv::OpLoad, {uint_, value, pointer});
    return value;
  }

  /// The function that all accesses call, so that their blocks stay as they are: uint check(index, high, count,
  /// access).
  void defineCheck() {
    const Id index = next_++, high = next_++, count = next_++, access = next_++, start = next_++, fault = next_++,
             record = next_++, recorded = next_++, end = next_++, isLess = next_++, isLow = next_++, isInside = next_++,
             before = next_++, isFirst = next_++, inside = next_++;
    const bool vulkanModel = std::ranges::any_of(all_, [](const SpirvInstruction& i) {
      return i.op == spv::OpMemoryModel && i.operands[1] == spv::MemoryModelVulkan;
    });
    // The model of Vulkan has no device scope unless the module asks for it.
    const Id scope = constant(vulkanModel ? spv::ScopeQueueFamily : spv::ScopeDevice), none = constant(0);
    put(functions_, spv::OpFunction, {uint_, check_, spv::FunctionControlMaskNone, checkType_});
    for (const Id parameter : {index, high, count, access})
      put(functions_, spv::OpFunctionParameter, {uint_, parameter});
    put(functions_, spv::OpLabel, {start});
    put(functions_, spv::OpULessThan, {bool_, isLess, index, count});
    put(functions_, spv::OpIEqual, {bool_, isLow, high, none});
    put(functions_, spv::OpLogicalAnd, {bool_, isInside, isLess, isLow});
    put(functions_, spv::OpSelectionMerge, {end, spv::SelectionControlMaskNone});
    put(functions_, spv::OpBranchConditional, {isInside, end, fault});
    put(functions_, spv::OpLabel, {fault});
    const Id word = pointerTo(kFaultAccess);
    put(functions_, spv::OpAtomicCompareExchange, {uint_, before, word, scope, none, none, access, none});
    put(functions_, spv::OpIEqual, {bool_, isFirst, before, none});
    put(functions_, spv::OpSelectionMerge, {recorded, spv::SelectionControlMaskNone});
    put(functions_, spv::OpBranchConditional, {isFirst, record, recorded});
    put(functions_, spv::OpLabel, {record});
    put(functions_, spv::OpStore, {pointerTo(kFaultIndex), index});
    put(functions_, spv::OpStore, {pointerTo(kFaultHigh), high});
    put(functions_, spv::OpStore, {pointerTo(kFaultCount), count});
    put(functions_, spv::OpBranch, {recorded});
    put(functions_, spv::OpLabel, {recorded});
    put(functions_, spv::OpBranch, {end});
    put(functions_, spv::OpLabel, {end});
    put(functions_, spv::OpSelect, {uint_, inside, isInside, index, none});
    put(functions_, spv::OpReturnValue, {inside});
    put(functions_, spv::OpFunctionEnd, {});
  }

  const Words& words_;
  const std::vector<SpirvInstruction> all_;
  const Module module_;
  std::map<std::uint32_t, std::string> names_;  // of resources, by binding
  Id next_;                                     // the first that is free
  Id uint_ = 0, bool_ = 0, checkType_ = 0, check_ = 0, wordPointer_ = 0, record_ = 0;
  std::map<std::uint32_t, Id> constants_;
  Words annotations_, globals_, functions_;  // what is added ahead of the types, behind them, and all functions
  CheckedSpirv made_;
};

}  // namespace

CheckedSpirv addBoundsChecks(const std::vector<std::uint32_t>& words,
                             const std::map<std::string, std::uint32_t>& resources) {
  return Checker(words, resources).run();
}

}  // namespace tessera::kernels
