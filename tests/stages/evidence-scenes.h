// What the evidence is gathered from.
#pragma once

#include <tessera/error.h>
#include <tessera/input.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "evidence.h"
#include "tests/support/compare.h"
#include "tests/support/machines.h"

namespace tessera::test {

/// The sphere fills 300 x 300 pixels; some of its triangles lie between samples.
inline Scene sphere() { return loadInput("generate:icosphere?level=5", 300, 300); }
/// A large triangle with w from 1 to 4, reaching behind the near plane.
inline Scene crossing() {
  Scene scene;
  scene.width = scene.height = 128;
  scene.clip = {{-1, -1, 0.5f, 1}, {4, -4, 2, 4}, {0, 2, -0.5f, 2}};
  scene.triangles = {{0, 1, 2}};
  return scene;
}

inline Frame on(const Scene& scene, const Variant& variant) {
  return machineAt<Cpu>()->render(scene, variant, {.countWork = variant.get("counters") == ""});
}
inline std::uint64_t count(const Frame& frame, const char* counter) { return frame.counters.at(counter); }
inline bool ran(const Frame& frame, const std::string& stage) {
  return std::ranges::any_of(frame.times.stages, [&](const auto& s) { return s.first == stage; });
}
inline std::string refusal(const Scene& scene, const Variant& variant, ExitCode code) {
  try {
    on(scene, variant);
  } catch (const Error& error) {
    CHECK(error.code() == code);
    return error.what();
  }
  return "";
}

/// Two triangles whose corners are the samples of pixels (5, 5) and (15, 15).
inline Scene sampleSquare() {
  Scene scene;
  scene.width = scene.height = 32;
  for (const auto& [x, y] : {std::pair{5.5f, 5.5f}, {15.5f, 5.5f}, {15.5f, 15.5f}, {5.5f, 15.5f}})
    scene.clip.emplace_back(x / 16 - 1, y / 16 - 1, 0.5f, 1.0f);
  scene.triangles = {{0, 1, 2}, {0, 2, 3}};
  return scene;
}
/// All x and y of the sphere's pieces, 1/256 pixel.
inline std::vector<int> corners(const Variant& variant) {
  const Frame frame = machineAt<Cpu>()->render(sphere(), variant, {.keepStages = true});
  const auto setup = std::ranges::find(frame.stages, "setup", &StageOutput::stage);
  std::vector<int> all;
  for (std::size_t i = 0; i + 9 < setup->values.size(); i += setup->words)
    if (setup->values[i + 9] != kNoTriangle)
      for (std::size_t k = 0; k < 6; ++k) all.push_back(static_cast<int>(setup->values[i + k]));
  return all;
}
/// The lowest bit that is set in any of them.
inline int finestBit(const std::vector<int>& values) {
  int bits = 0;
  for (const int value : values) bits |= value;
  return bits & -bits;
}

}  // namespace tessera::test
