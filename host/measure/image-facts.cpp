#include "host/measure/image-facts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/input.h>

#include <algorithm>
#include <string>
#include <vector>

#include "host/build-info.h"
#include "host/support/matrix.h"

namespace tessera::measure {
namespace {

constexpr char kVersion[] = TESSERA_VERSION " (" TESSERA_GIT ")";

AxisKind kindOf(const std::string& axisName, const std::string& value) {
  const Axis& found = axis(axisName);
  return found.values.empty() || found.kind() == AxisKind::kImage ? found.kind() : axisValue(axisName, value).kind;
}

/// Clip space from the input's coordinates, row-major: M translate(-O), in double where there is an origin O.
std::string cameraText(const Scene& scene) {
  if (scene.origin == glm::dvec3(0)) return fmt::format("{}", fmt::join(scene.clipFromObject, " "));
  support::DoubleMatrix clipFromPositions;
  std::ranges::copy(scene.clipFromObject, clipFromPositions.begin());
  return fmt::format("{}", fmt::join(support::translated(clipFromPositions, -scene.origin), " "));
}

}  // namespace

ImageFacts factsOf(const std::string& shows) { return {{"shows", shows}, {"version", kVersion}}; }

ImageFacts factsOf(const Run& run) {
  const Scene& scene = *run.scene;
  ImageFacts facts;
  std::vector<std::string> image, approximate;
  for (const auto& [axis, value] : run.variant.values()) {
    const AxisKind kind = kindOf(axis, value);
    if (kind == AxisKind::kImage) image.push_back(axis + '=' + value);
    if (kind == AxisKind::kApproximate) approximate.push_back(axis + '=' + value);
  }
  // In the order of their names, as they are read.
  if (!approximate.empty()) facts.emplace_back("approximate", fmt::format("{}", fmt::join(approximate, " ")));
  if (const auto streams = interpolatedStreams(scene); !streams.empty()) {
    std::vector<std::string> names;
    for (const Stream* stream : streams) names.push_back(stream->name);
    facts.emplace_back("attribute", fmt::format("{}", fmt::join(names, " ")));
  }
  if (!scene.positions.empty()) facts.emplace_back("camera", cameraText(scene));
  facts.emplace_back("image", fmt::format("{}", fmt::join(image, " ")));
  if (!run.kernelFiles.empty()) {
    std::vector<std::string> kernels;
    for (const auto& [stage, file] : run.kernelFiles) kernels.push_back(stage + '=' + file.second);
    facts.emplace_back("kernels", fmt::format("{}", fmt::join(kernels, " ")));
  }
  if (scene.origin != glm::dvec3(0))
    facts.emplace_back("origin", fmt::format("{} {} {}", scene.origin.x, scene.origin.y, scene.origin.z));
  if (scene.attribute() != nullptr && run.attributeRange)
    facts.emplace_back("range", fmt::format("{} {}", run.attributeRange->least, run.attributeRange->most));
  facts.emplace_back("raster", fmt::format("{} x {}", scene.width, scene.height));
  facts.emplace_back("scene", sceneHash(scene));
  facts.emplace_back("version", kVersion);
  return facts;
}

}  // namespace tessera::measure
