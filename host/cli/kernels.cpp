// tessera kernels: compiles ahead what rendering would compile at first use.
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <memory>

#include "datasets/input.h"
#include "host/cli/commands.h"
#include "host/cli/common.h"
#include "host/cli/progress.h"
#include "host/kernel-cache.h"
#include "host/rasterizer.h"

namespace tessera::cli {
namespace {

struct KernelsOptions : Options {
  bool prebuild = false;
};

/// A small scene that needs every pass: a sphere seen in perspective, with a triangle that crosses the near plane.
Scene everyPass() {
  Scene scene = loadInput("generate:icosphere?level=1", 64, 64);
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  // Through the camera's own axis: from the middle of the sphere to far outside it on either side of the eye.
  for (const float z : {-100.0f, 100.0f}) scene.positions.push_back({0.1f, 0.1f, z});
  scene.positions.push_back({0.2f, 0.3f, 0.0f});
  if (!scene.normals.empty()) scene.normals.resize(scene.positions.size(), {0, 0, 1});
  scene.triangles.push_back({first, first + 1, first + 2});
  return scene;
}

ExitCode runKernels(const KernelsOptions& options) {
  constexpr std::array kShades{"none", "flat", "smooth"};
  const auto names = options.devices.empty() ? presentDevices() : options.devices;
  const Scene scene = everyPass();
  KernelCache kernels;
  Progress progress("compiling kernels", names.size() * kShades.size());
  for (std::size_t d = 0; d < names.size(); ++d) {
    const auto device = openDevice(names[d], 0);
    Rasterizer rasterizer(*device, kernels);
    for (std::size_t s = 0; s < kShades.size(); ++s) {
      progress.at(d * kShades.size() + s, fmt::format("{}, shade={}", names[d], kShades[s]));
      rasterizer.render(scene, {{"shade", kShades[s]}}, {.readBack = false});
    }
  }
  fmt::print("the kernels of the default variants are ready in {}\n", kernels.folder().string());
  return ExitCode::kDone;
}

}  // namespace

Command addKernels(CLI::App& app) {
  auto options = std::make_shared<KernelsOptions>();
  auto* const command = app.add_subcommand("kernels", "compile kernels ahead of their first use");
  command->add_flag("--prebuild", options->prebuild, "compile those of the default variants into the kernel cache")->required();
  addDevice(*command, *options, true);
  return {command, [options] { return runKernels(*options); }};
}

}  // namespace tessera::cli
