// One run as one line of JSON: what experiments keep, plot and compare.
#pragma once

#include <tessera/device.h>
#include <tessera/error.h>
#include <tessera/image.h>
#include <tessera/oracle.h>
#include <tessera/rasterizer.h>
#include <tessera/scene.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tessera::measure {

inline constexpr int kRowSchemaVersion = 3;

/// What a run leaves behind. A member that is empty leaves its field out of the row.
struct Run {
  std::string status = "ok";  ///< ok, overflow, unsupported, timeout or error
  std::string message;        ///< one line: why the status is not ok
  Variant variant;            ///< resolved by the plan where there is one, else as it was asked for
  const Scene* scene = nullptr;
  DeviceInfo device;
  std::vector<FrameTimes> samples;              ///< one a timed frame, raw
  std::optional<Difference> difference;         ///< from the oracle
  std::optional<std::uint64_t> wrongWinners;    ///< pixels whose triangle is not the oracle's: by id, else by colour
  std::optional<std::uint64_t> hitCountNotOne;  ///< pixels that are hit, but not once; of commit=count
  std::optional<oracle::AttributeError> attributeError;     ///< from the exact value
  std::optional<ValueRange> attributeRange;                 ///< that was asked for
  Counters counters;
  std::vector<PlanEntry> plan;
  std::string slang;                           ///< version of the slangc in use
  std::string kernelCompiler;                  ///< C++ compiler of the CPU's kernels, with flags and target
  std::map<std::string, std::string> kernels;  ///< stage -> content hash
  std::map<std::string, std::pair<std::string, std::string>> kernelFiles;  ///< stage -> a user's file, its SHA-256
  std::uint64_t peakBufferBytes = 0;
  Variant truth;                              ///< image axes of a picture that errors are also measured from
  std::optional<Difference> truthDifference;  ///< from the oracle under these
  std::string picture;                        ///< of the differences: a path
  std::optional<std::uint64_t> seed;          ///< of the order in which a sweep's cells took their turns
};

/// Order statistics of a sample, linear between neighbours; nanoseconds. All 0 for an empty sample.
struct Spread {
  double median = 0, min = 0, iqr = 0, max = 0;
  std::size_t count = 0;

  /// How far the median may be off, as a share of it: 1.57 interquartile ranges over the square root of the count, the
  /// notch of McGill, Tukey and Larsen, Variations of box plots, 1978. Medians of two samples whose notches do not
  /// overlap differ at the 95 % level. Of a sample of one it says nothing, and is 0.
  double medianError() const;
};
Spread spread(std::vector<std::uint64_t> sample);
Spread totalSpread(const std::vector<FrameTimes>& samples);  ///< of the frames' total times
/// Median time of each stage over the frames, in the order of the first frame's stages.
std::vector<std::pair<std::string, double>> stageMedians(const std::vector<FrameTimes>& samples);
/// Pixels that a triangle covers, in whichever of ids and hits the frame holds.
std::uint64_t coveredPixels(const Framebuffer& frame);
/// The row's word for an error: "overflow", "unsupported" or "error".
std::string statusOf(ExitCode code);

/// The row's `error` of a difference alone: an object in JSON, of numbers, and null for what there was not to compare
/// or is not finite.
std::string differenceText(const Difference& difference);
/// Now, as rows have it: "2026-11-23T09:26:00Z".
std::string utcText();
/// The row, without a line's end. Bytes of names that are not UTF-8 are replaced.
std::string rowText(const Run& run);

}  // namespace tessera::measure
