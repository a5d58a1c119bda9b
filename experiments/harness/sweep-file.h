// sweep.toml: what varies, on which scenes, how often. experiments/README.md documents the keys.
#pragma once

#include <tessera/input.h>
#include <tessera/kernel-cache.h>
#include <tessera/variant.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tessera::harness {

inline constexpr unsigned kMaxRounds = 1000;
inline constexpr unsigned kMaxFrames = 1000;  ///< of a turn: to warm up, and to be timed

struct SweepScene {
  std::string name;   ///< its key in [scenes]
  std::string input;  ///< as loadInput takes it; a path is relative to the working folder
  std::string text;   ///< the input as the file has it, for rows and commands
  AttributeRequest attribute;
  std::optional<double> x;  ///< the number that the scene stands for on plots, e.g. its triangles' area in pixels
};

/// One axis of variation and its values, in the file's order.
struct SweptAxis {
  std::string axis;
  std::vector<std::string> values;
};

struct Size {
  std::uint32_t width = 0, height = 0;
  bool operator==(const Size&) const = default;
};

/// A stage whose kernel varies: "" is the stage's own, others are files as `render --kernel` takes them.
struct SweptKernel {
  std::string stage;
  std::vector<std::filesystem::path> files;  ///< relative to the working folder
  std::vector<std::string> texts;            ///< as the file has them
};

/// Combinations that are not made: those that have one of the values for each of the axes named.
using LeaveOut = std::vector<std::pair<std::string, std::vector<std::string>>>;

/// What a cell is made of: axis -> value, set and swept, and "kernel:STAGE" -> the file as written ("": its own).
using Labels = std::map<std::string, std::string>;

struct Sweep {
  std::filesystem::path path;  ///< of the file
  std::string text;            ///< of the file
  std::string sha256;          ///< of the text
  std::string title, question;
  std::uint64_t seed = 1;  ///< of the order in which cells take their turns
  std::vector<SweepScene> scenes;
  std::vector<Size> sizes;
  std::vector<std::string> devices;  ///< names as --device takes them
  std::vector<unsigned> threads{0};  ///< of devices that take a number (DeviceKind::takesThreads); 0: all cores
  Variant set;                       ///< axes that are the same in every cell
  std::vector<SweptAxis> axes;
  std::vector<SweptKernel> kernels;
  std::string
      foreignKernel;  ///< why they are not run unasked: the first that lies outside the file's folder; "" if none
  std::vector<LeaveOut> leaveOut;
  std::vector<Variant> also;  ///< axes of one more cell each, outside the product; with `set`
  Variant reference;          ///< the first cell that has these is the one whose time the others are divided by
  Variant truth;              ///< image axes of the picture that `truth_error` is measured from; empty: none
  unsigned rounds = 5;        ///< each cell has its turn once a round
  unsigned warmUp = 1;        ///< frames before each turn's timed ones, not timed
  unsigned repeats = 1;       ///< timed frames a turn
  double timeLimitS = 60;     ///< a frame that takes longer ends its cell: status timeout
  bool quick = false;         ///< [quick] has taken the place of scenes, sizes, rounds and repeats
};

/// What the command line says in place of the file.
struct Changes {
  unsigned rounds = 0;               ///< 0: the file's
  std::vector<std::string> devices;  ///< empty: the file's
};

/// Throws kUsage with "file:line:column: key: what is wrong; what would be right". Checks every key (those of [plot]
/// and
/// [[expect]] too, which others read), axes and values against the list of axes, and that the reference is one of the
/// cells. `quick`: as [quick] says, which has to be there. `changes` come last, and are checked as the file's are.
Sweep readSweep(const std::filesystem::path& path, bool quick = false, const Changes& changes = {});

/// All that varies, each with its values: [axes] in the file's order, axes that only [[also]] has, kernels as
/// "kernel:STAGE".
std::vector<SweptAxis> sweptAxes(const Sweep& sweep);

/// The cells of one group: the product without what is left out, its last axis turning fastest, then [[also]].
std::vector<Labels> combinations(const Sweep& sweep);

}  // namespace tessera::harness
