// What is measured for one scene, and for memory.
#pragma once

#include <tessera/image.h>
#include <tessera/rasterizer.h>

#include <cstdint>
#include <string>
#include <vector>

#include "bench/scenes.h"

namespace tessera::bench {

struct Comparison {
  std::string scene;
  std::size_t triangles = 0;
  std::uint32_t size = 0;                           ///< width and height, pixels
  std::vector<FrameTimes> cpu, again;               ///< the CPU device, twice a round: their difference is noise
  std::vector<std::uint64_t> drawDevice, drawWall;  ///< ns, the graphics pipeline
  Difference difference;                            ///< of the two images
  std::uint64_t covered = 0;                        ///< pixels of the CPU device's image
};

struct Memory {
  std::string scene;
  std::uint64_t peakResident = 0;  ///< bytes, of a process that loads the scene and renders it once on the CPU device
  std::uint64_t peakBuffers = 0;   ///< bytes, of the device's buffers
};

/// For a process of its own: loads the scene, renders it, prints the two figures.
void printMemory(const std::string& scene, std::uint32_t size, unsigned threads);
/// Starts that process, which is this program again.
Memory measureMemory(const std::string& scene, std::uint32_t size, unsigned threads);

struct Report {
  std::vector<std::pair<std::string, std::string>> provenance;
  std::string drawDevice;
  std::vector<Comparison> comparisons;
  std::vector<Memory> memory;
};

/// Tables for people.
std::string text(const Report& report);
/// Medians and spreads; with `raw`, every sample too.
std::string json(const Report& report, bool raw);

}  // namespace tessera::bench
