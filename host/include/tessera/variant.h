// The axes of variation: one list drives the command line, the kernels, the tests, the sweeps and the docs.
#pragma once

#include <compare>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// What a value may change.
enum class AxisKind {
  kImage,           ///< changes what is right; the oracle takes it too
  kImplementation,  ///< may change no bit
  kApproximate,     ///< the error is measured and shown with every result
};
const char* kindName(AxisKind kind);  ///< "image", "implementation", "approximate"

/// What a value asks of the device, and what the host has to do for it.
enum Feature : unsigned {
  kNeedsInt64 = 1,      ///< 64-bit integers
  kNeedsFloat64 = 2,    ///< 64-bit floats
  kNeedsAtomics64 = 4,  ///< 64-bit atomics
  kNeedsCpu = 8,        ///< the CPU device
  kNeedsVulkan = 16,    ///< a Vulkan device
  kWritesTiles = 32,    ///< a commit that writes all pixels of its tiles: nothing has to be cleared
  kResolves = 64,       ///< a commit whose words become depth and ids in `resolve`
  kKeepsColours = 128,  ///< a commit that packs a colour of the triangle instead of its id
  kTwoPasses = 256,     ///< a commit that rasterises twice
};

/// One value of an axis.
struct AxisValue {
  std::string name;     ///< as people type it
  std::string meaning;  ///< one line
  std::string slang;    ///< what the generated module says for it; empty: a host path
  AxisKind kind = AxisKind::kImplementation;  ///< what the value may change
  unsigned features = 0;    ///< of Feature
  std::string source = {};  ///< paper or specification, where it is not the axis'
  std::string limits = {};  ///< bound of the error, largest scene: one line

  /// Whether it has one of these features.
  bool has(unsigned feature) const { return (features & feature) != 0; }
};

/// One axis: what can be done in more than one way.
struct Axis {
  std::string name;                      ///< as people type it
  std::string meaning;                   ///< one line
  std::string source = {};               ///< paper or specification
  std::vector<std::string> stages = {};  ///< kernels that read it, by stage name; empty: the host reads it
  std::vector<AxisValue> values = {};    ///< empty: an integer from `least` to `most`
  std::string unset = {};                ///< what the plan chooses when it is not set, in words
  /// Whether its values are Slang types, which the module `variant` names; else constants, which go into `settings`.
  bool types = false;
  long least = 0;  ///< the least value of an integer axis
  long most = 0;   ///< the largest value of an integer axis

  AxisKind kind() const;  ///< implementation where any value is; its other values say so themselves
};

/// All axes, in pipeline order.
const std::vector<Axis>& axes();
/// The axis of that name. Throws kUsage, naming the axes there are.
const Axis& axis(std::string_view name);
/// The value of that name. Throws kUsage, naming the values there are. The axis has names for values.
const AxisValue& axisValue(std::string_view axis, std::string_view value);

/// Values that go only with some values of another axis.
struct AxisRule {
  std::string axis;                 ///< the axis that the rule is about
  std::vector<std::string> values;  ///< of that axis; empty: whatever it is set to
  std::string other;                ///< the other axis
  std::vector<std::string> only;    ///< values of the other axis that go with these
  std::string why;                  ///< one line
};
/// All rules.
const std::vector<AxisRule>& axisRules();

/// Chosen values. An axis that is not set is the plan's choice; a set one is honoured or refused.
class Variant {
 public:
  Variant() = default;  ///< nothing is set
  /// Sets pairs of axis and value. Throws as set() does.
  Variant(std::initializer_list<std::pair<std::string_view, std::string_view>> settings);
  /// Throws kUsage for an unknown axis or value, naming those there are.
  void set(std::string_view axis, std::string_view value);
  /// Sets an axis by a text "axis=value".
  void set(std::string_view assignment);
  bool has(std::string_view axis) const;  ///< whether the axis is set
  /// The value, or `otherwise` where it is not set.
  std::string get(std::string_view axis, std::string_view otherwise = "") const;
  /// What is set: axis -> value.
  const std::map<std::string, std::string>& values() const { return values_; }
  std::string text() const;  ///< "axis=value axis=value" in axis order; "" when nothing is set

 private:
  std::map<std::string, std::string> values_;
};

/// Whether a set or resolved value is one whose error has to be measured.
bool isApproximate(const Variant& variant);

/// The two generated Slang modules of a kernel.
struct VariantModules {
  std::string
      settings;         ///< text of settings.slang: constants, and what the lowest modules are made of; imports nothing
  std::string variant;  ///< text of variant.slang: the chosen types, each a file that fulfils an interface
  std::string text() const { return settings + variant; }  ///< the two texts, one after the other
  /// Compares the texts.
  auto operator<=>(const VariantModules&) const = default;
};
/// Those of one stage: only the axes that the stage reads, so that its key holds no other. `resolved` has a value for
/// each of them.
VariantModules variantModules(std::string_view stage, const Variant& resolved);

}  // namespace tessera
