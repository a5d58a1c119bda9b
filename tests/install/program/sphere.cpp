// Renders a generated mesh on the CPU, through the installed library alone.
#include <tessera/tessera.h>

#include <cstdio>

int main() {
  tessera::Scene scene = tessera::loadInput("generate:icosphere?level=3");
  scene.width = scene.height = 256;
  auto device = tessera::makeCpuDevice();
  tessera::KernelCache kernels({.folder = {}, .slangSources = SLANG_SOURCES, .boundsChecks = false, .extraCxxFlags = {}});
  const tessera::Frame frame = tessera::Rasterizer(*device, kernels).render(scene);

  std::size_t covered = 0;
  for (const std::uint32_t id : frame.image.ids) covered += id != tessera::kNoTriangle;
  tessera::writeImage("sphere.png", frame.image);
  std::printf("%zu triangles cover %zu of %zu pixels\n", scene.triangles.size(), covered, frame.image.pixels());
}
