// The axes of variation: one list drives the command line, the kernels, the tests, the sweeps and the docs.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tessera {

/// What a value may change.
enum class AxisKind {
  kImage,           ///< changes what is right; the oracle takes it too
  kImplementation,  ///< may change no bit
  kApproximate,     ///< the error is measured and shown with every result
};
const char* kindName(AxisKind kind);  ///< "image", "implementation", "approximate"

/// What a value needs of a device.
struct Needs {
  bool int64 = false;        ///< 64-bit integers (DeviceInfo::int64)
  bool float64 = false;      ///< 64-bit floats (DeviceInfo::float64)
  bool atomicMin64 = false;  ///< 64-bit atomic min on buffers (DeviceInfo::atomicMin64)
  /// A group of lanes is one thread, which loops over them: a lane that waits for another group's lane gets it.
  bool oneThreadGroups = false;
};

/// What a commit asks of the host, and what it leaves behind.
struct CommitTraits {
  bool writesTiles = false;             ///< it writes every pixel of its tiles: nothing has to be cleared
  bool wantsBins = false;               ///< it is at its best where pieces come by tiles
  bool resolves = false;                ///< what it packs becomes depth and ids in the stage `resolve`
  bool keepsColours = false;            ///< it packs a colour of the triangle in place of the triangle's id
  bool keepsIds = true;                 ///< later stages find the triangle of each pixel
  unsigned passes = 1;                  ///< times that all triangles go through the raster
  std::uint64_t mostTriangles = ~0ull;  ///< that it can tell apart
};

/// How many iterations a lane of the raster takes for one entry of its tile. A tile is `across` cells wide:
/// iterations <= perCell * across * across + perRow * across + fixed. A loop of n passes counts n + 1, with its last
/// test.
struct LoopBound {
  std::uint64_t perCell = 0;  ///< iterations for each cell
  std::uint64_t perRow = 0;   ///< iterations for each row of cells
  std::uint64_t fixed = 0;    ///< iterations for each entry
};

/// One value of an axis.
struct AxisValue {
  std::string name;     ///< as people type it
  std::string meaning;  ///< one line
  std::string slang;    ///< what the generated module says for the value; empty: the host alone reads it
  AxisKind kind = AxisKind::kImplementation;  ///< what the value may change
  Needs needs = {};         ///< of a device
  std::string source = {};  ///< paper or specification, where it is not the axis'
  std::string limits = {};  ///< bound of the error, largest scene: one line
  std::variant<std::monostate, CommitTraits, LoopBound> traits = {};  ///< of a value of `commit`, of `traversal`
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
/// The traits of a value of the axis `commit`.
const CommitTraits& commitTraits(std::string_view commit);
/// The loop bound of a value of the axis `traversal`.
const LoopBound& loopBound(std::string_view traversal);

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
  /// "axis=value axis=value", with blanks between the settings, as text() has them and `--set` takes them; "" sets
  /// nothing. Throws kUsage for an unknown axis or value, naming those there are, for an axis without a value and for
  /// an axis that is set twice.
  explicit Variant(std::string_view settings);
  /// Throws kUsage for an unknown axis or value, naming those there are.
  void set(std::string_view axis, std::string_view value);
  bool has(std::string_view axis) const;  ///< whether the axis is set
  /// The value, or `otherwise` where it is not set.
  std::string get(std::string_view axis, std::string_view otherwise = "") const;
  /// The value of an axis that is set, as a number. Throws kFailure where it is none.
  std::uint32_t number(std::string_view axis) const;
  /// Whether the axis is set to `value`, which has to be one of the axis' values: kUsage otherwise.
  bool is(std::string_view axis, std::string_view value) const;
  /// Whether the axis is set to `on`.
  bool isOn(std::string_view axis) const { return is(axis, "on"); }
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
