// try-extended stage|binning|commit: renders with what was added, on the CPU and on a Vulkan device, and holds the frames against the oracle
// and against plain code. Exit code 1 with a line where they differ, and where nothing was added.
#include <tessera/device-kind.h>
#include <tessera/tessera.h>

#include <cstdio>
#include <cstring>
#include <string>

#include "host/axes/settings.h"
#include "host/oracle/oracle-image.h"

using namespace tessera;

namespace {

Scene soup() {
  Scene scene = loadInput("generate:soup?count=500&pixels=300", 200, 150);
  Stream& weight = scene.makeStream("weight", 1, false);
  for (std::size_t v = 0; v < scene.vertexCount(); ++v) weight.values.push_back(static_cast<float>(v) + 0.5f);
  return scene;
}

bool hasBits(const Framebuffer& frame, const Framebuffer& oracle) {
  return frame.ids == oracle.ids && std::memcmp(frame.depth.data(), oracle.depth.data(), 4 * oracle.depth.size()) == 0;
}

bool isOutline(const Framebuffer& frame, const Scene& scene) {
  const Channel* const channel = frame.channel("outline");
  if (channel == nullptr || channel->floats().size() != frame.pixels()) return false;
  for (std::size_t k = 0; k < frame.pixels(); ++k) {
    const bool edge = k % frame.width == frame.width - 1 || frame.ids[k + 1] != frame.ids[k];
    const float weight = frame.ids[k] == kNoTriangle ? 0
                                                     : scene.stream("weight")->values[scene.triangles[frame.ids[k]][0]];
    if (channel->floats()[k] != (edge ? weight : 0)) return false;
  }
  return true;
}

}  // namespace

int main(int count, char** arguments) try {
  const std::string what = count > 1 ? arguments[1] : "";
  const Scene scene = soup();
  const Framebuffer oracle = oracle::render(scene, oracle::imageAxesOf({})).image;
  for (const char* name : {"cpu", "vulkan"}) {
    const auto device = openDevice(name);
    KernelCache kernels;
    Rasterizer rasterizer(*device, kernels);
    const std::string setting = what == "binning" ? "binning=reverse" : what == "commit" ? "commit=stamp" : "";
    const Frame frame = rasterizer.render(scene, Variant(setting));
    const bool right = hasBits(frame.image, oracle) && (what != "stage" || isOutline(frame.image, scene));
    std::printf("%s on %s: %s\n", what.c_str(), name, right ? "right" : "wrong");
    if (!right) return 1;
  }
  return 0;
} catch (const Error& error) {
  std::printf("%s\n", error.what());
  return 1;
}
