// A sweep's cells: what is rendered and timed, in an order that every machine agrees on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/harness/sweep-file.h"

namespace tessera::harness {

/// One variant of one scene at one size on one device. Its place in cells() is its number in journal and rows, which
/// call it a cell, as commands and pages do; a cell of the raster is 8 x 8 pixels.
struct SweepPoint {
  std::size_t number = 0;
  std::size_t scene = 0;  ///< of Sweep::scenes
  Size size;
  std::string device;
  unsigned threads = 0;    ///< 0 where the device takes no number of threads
  Variant asked;           ///< set and swept axes
  KernelFiles kernels;     ///< user's kernels; a stage's own is not in it
  Labels labels;           ///< `asked` and kernels, for rows
  bool reference = false;  ///< the one of its group (same scene, device, size, threads) that others are divided by
  bool twin = false;       ///< the reference once more: A/A. Follows its reference in cells()
  std::size_t group = 0;   ///< cells that are compared with each other have the same
};

/// Cells that are interleaved with each other, on one device and scene, all sizes and numbers of threads: what one
/// machine has to do in one go.
struct Job {
  std::string name;  ///< "SCENE@DEVICE"
  std::size_t scene = 0;
  std::string device;
  std::vector<std::size_t> cells;  ///< numbers
};

/// Devices, then scenes, sizes, threads, then the product of the axes and kernels, the last of which turns fastest.
std::vector<SweepPoint> cells(const Sweep& sweep);
std::vector<Job> jobs(const Sweep& sweep, const std::vector<SweepPoint>& cells);
/// What varies, as the cell has it: "tile=8 binning=exact"; "" where nothing does.
std::string variantName(const Sweep& sweep, const SweepPoint& cell);
/// "scene 1024x1024 cpu, tile=8 binning=exact": for messages.
std::string cellName(const Sweep& sweep, const SweepPoint& cell);
/// The `tessera render` line, for sh in the sweep's folder, that renders what the cell does, as often.
std::string cellCommand(const Sweep& sweep, const SweepPoint& cell);

/// What such a line is made of.
struct Command {
  std::string input;  ///< as the sweep's file has it
  Size size;
  std::string device;
  unsigned threads = 0;          ///< 0: not said
  Labels labels;                 ///< of axes that there are; others are left out
  std::string attribute, range;  ///< "": not said
  unsigned frames = 1;
};
std::string commandText(const Command& parts);
/// The words of such a line, without their quotes. Of another text they may be anything: commandText() of what they say
/// is then another text.
std::vector<std::string> commandWords(std::string_view command);

/// Where the sweep names no reference, that of a group is its first cell that is not refused; the twin keeps its
/// number, so that cells have the same on each machine. Whether there was anything to change.
bool chooseReferences(const Sweep& sweep, std::vector<SweepPoint>& cells,
                      const std::function<bool(std::size_t)>& refused);
/// Makes this cell its group's reference.
void makeReference(std::vector<SweepPoint>& cells, std::size_t number);

/// The order of a round: a permutation of `cells`, the same for the same seed, job and round (Fisher and Yates, with
/// datasets/random.h).
std::vector<std::size_t> turnOrder(std::vector<std::size_t> cells, std::uint64_t seed, const std::string& job,
                                   unsigned round);

}  // namespace tessera::harness
