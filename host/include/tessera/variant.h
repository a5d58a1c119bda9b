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
  bool int64 = false;        ///< needs 64-bit integers (DeviceInfo::int64)
  bool float64 = false;      ///< needs 64-bit floats (DeviceInfo::float64)
  bool atomicMin64 = false;  ///< needs 64-bit atomic min on buffers (DeviceInfo::atomicMin64)
  bool groupAtomicMin64 = false;  ///< needs 64-bit atomic min in group memory (DeviceInfo::groupAtomicMin64)
  /// Needs groups of one thread each, which loops over the group's lanes. A lane can then wait for a lane of another
  /// group, and the wait ends.
  bool oneThreadGroups = false;
};

/// What a commit asks of the host, and what it leaves behind.
struct CommitTraits {
  bool writesTiles = false;             ///< it writes every pixel of its tiles, so nothing has to be cleared
  bool wantsBins = false;               ///< it is at its best where pieces come tile by tile
  bool resolves = false;                ///< the stage `resolve` turns what it packs into depth and ids
  bool keepsColours = false;            ///< it packs a colour of the triangle in place of the triangle's id
  bool keepsIds = true;                 ///< later stages find the triangle of each pixel
  unsigned passes = 1;                  ///< how often all triangles go through the raster
  std::uint64_t mostTriangles = ~0ull;  ///< how many triangles it can tell apart
};

/// How many iterations a lane of the raster takes for the entries of its tile. In a tile that is `across` cells wide
///
///     iterations <= (perCell * across * across + perRow * across + fixed) * entries + once
///
/// A loop of n passes counts n + 1 iterations, since its last test counts, too.
struct LoopBound {
  std::uint64_t perCell = 0;  ///< iterations for each cell
  std::uint64_t perRow = 0;   ///< iterations for each row of cells
  std::uint64_t fixed = 0;    ///< iterations for each entry
  std::uint64_t once = 0;     ///< iterations for each dispatch
};

/// One value of an axis.
struct AxisValue {
  std::string name;     ///< as people type it
  std::string meaning;  ///< what the value means, in one line
  std::string slang;    ///< what the generated module says for the value; empty where the host alone reads the value
  AxisKind kind = AxisKind::kImplementation;  ///< what the value may change
  Needs needs = {};                           ///< what the value needs of a device
  std::string source = {};                    ///< paper or specification, where it is not Axis::source
  std::string limits = {};                    ///< such as the bound of the error or the largest scene, in one line
  std::variant<std::monostate, CommitTraits, LoopBound> traits = {};  ///< of a value of `commit`, or of one that the walk over entries takes
};

/// One axis: what can be done in more than one way.
struct Axis {
  std::string name;                      ///< as people type it
  std::string meaning;                   ///< what the axis means, in one line
  std::string source = {};               ///< paper or specification
  std::vector<std::string> stages = {};  ///< stages whose kernels read the axis; empty where the host alone does
  std::vector<AxisValue> values = {};    ///< empty where a value is an integer from `least` to `most`
  std::string unset = {};                ///< what the plan chooses where the axis is not set, in words
  /// Whether the axis' values are Slang types, which the module `variant` names. Otherwise the values are constants,
  /// which the module `settings` holds.
  bool types = false;
  long least = 0;  ///< the least value of an integer axis
  long most = 0;   ///< the largest value of an integer axis

  AxisKind kind() const;  ///< kImplementation where any value has this kind; see AxisValue::kind for each value
};

/// All axes, in pipeline order.
const std::vector<Axis>& allAxes();
/// The axis `name`. Throws kUsage where no axis has this name; the message names the axes.
const Axis& axis(std::string_view name);
/// The value `value` of an axis whose values have names. Throws kUsage where the axis has no such value; the message
/// names the values.
const AxisValue& axisValue(std::string_view axis, std::string_view value);
/// The traits of a value of the axis `commit`.
const CommitTraits& commitTraits(std::string_view commit);

/// Values of one axis that go only with some values of another axis.
struct AxisRule {
  std::string axis;                 ///< the axis that the rule is about
  std::vector<std::string> values;  ///< values of `axis`; empty for any value
  std::string other;                ///< the other axis
  std::vector<std::string> only;    ///< values of the axis `other` that go with `values`
  std::string why;                  ///< the reason, in one line
};
/// All rules.
const std::vector<AxisRule>& axisRules();

/// The values that a user has chosen. The plan chooses for an axis that is not set. A value that is set is honoured or
/// refused.
class Variant {
 public:
  Variant() = default;  ///< no axis is set
  /// Sets pairs of axis and value. Throws as set() does.
  Variant(std::initializer_list<std::pair<std::string_view, std::string_view>> settings);
  /// Sets axes from a text: "axis=value axis=value", with blanks between the settings, as text() gives and `--set`
  /// takes settings; "" sets no axis. Throws kUsage for an unknown axis or value, whose message names the known ones,
  /// for an axis without a value, and for an axis that is set twice.
  explicit Variant(std::string_view settings);
  /// Sets an axis. Throws kUsage for an unknown axis or value; the message names the known ones.
  void set(std::string_view axis, std::string_view value);
  bool has(std::string_view axis) const;  ///< whether the axis is set
  /// The value of the axis, or `otherwise` where the axis is not set.
  std::string get(std::string_view axis, std::string_view otherwise = "") const;
  /// The value of an axis that is set, as a number. Throws kFailure where the value is no number.
  std::uint32_t number(std::string_view axis) const;
  /// Whether the axis is set to `value`. Throws kUsage where `value` is not among the axis' values.
  bool is(std::string_view axis, std::string_view value) const;
  /// Whether the axis is set to `on`.
  bool isOn(std::string_view axis) const { return is(axis, "on"); }
  /// The axes that are set, each with its value.
  const std::map<std::string, std::string>& values() const { return values_; }
  std::string text() const;  ///< "axis=value axis=value" in axis order; "" where no axis is set

 private:
  std::map<std::string, std::string> values_;
};

/// The loop bounds of the values of a resolved variant, added up.
LoopBound loopBound(const Variant& resolved);

/// Whether a value of the variant, set or resolved, has an error that has to be measured.
bool isApproximate(const Variant& variant);

/// The two generated Slang modules of a kernel.
struct VariantModules {
  std::string
      settings;         ///< text of settings.slang: constants, and what the lowest modules are made of; imports nothing
  std::string variant;  ///< text of variant.slang: the chosen types; for each a file fulfils an interface
  unsigned laneWidth = 0;  ///< lanes of a vector of slang/machine/lanes.slang in C++; 0: the processor's own
  std::string text() const { return settings + variant; }  ///< the two texts, one after the other
  /// Compares the texts.
  auto operator<=>(const VariantModules&) const = default;
};
/// The modules of one stage. They hold only the axes that the stage reads, so that the key of the stage's kernel
/// depends on no other axis. `resolved` has a value for each axis that the stage reads.
VariantModules variantModules(std::string_view stage, const Variant& resolved);

}  // namespace tessera
