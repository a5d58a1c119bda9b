// The program's own arrays in; ids, depth and a stream out; on the CPU and on a Vulkan device, with the same bits.
#include <tessera/tessera.h>

#include <cstdio>
#include <vector>

int main() {
  const std::vector<glm::vec3> positions{{-0.9f, -0.8f, 0.2f}, {-0.2f, 0.9f, 0.6f}, {0.9f, -0.5f, 0.4f}, {0.5f, 0.8f, 0.1f}};
  const std::vector<tessera::Triangle> triangles{{0, 1, 2}, {1, 3, 2}};
  const std::vector<float> heat{10, 20, 40, 80};
  tessera::Scene scene{.width = 320, .height = 240};
  scene.positions = tessera::Array<glm::vec3>::borrow(positions);
  scene.triangles = tessera::Array<tessera::Triangle>::borrow(triangles);
  scene.streams.push_back({"heat", 1, tessera::Array<float>::borrow(heat)});
  tessera::KernelCache kernels({.slangSources = SLANG_SOURCES});
  std::vector<tessera::Framebuffer> images;
  for (const char* name : {"cpu", "vulkan"}) {
    const auto device = tessera::openDevice(name);
    images.push_back(tessera::Rasterizer(*device, kernels).render(scene).image);
  }
  const tessera::Framebuffer& image = images[0];
  const std::size_t k = image.pixels() / 2 + image.width / 2;
  std::printf("id %u, depth %g, heat %g\n", image.ids[k], image.depth[k], image.channel("heat")->floats()[k]);
  std::printf("%s\n", tessera::compare(images[0], images[1]).equal() ? "the same bits" : "different bits");
}
