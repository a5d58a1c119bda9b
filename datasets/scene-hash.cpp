#include <tessera/input.h>

#include <array>
#include <bit>
#include <span>

#include "host/support/sha256.h"

namespace tessera {
namespace {

static_assert(std::endian::native == std::endian::little, "the hash is of little-endian words");
static_assert(sizeof(glm::vec3) == 12 && sizeof(glm::vec4) == 16 && sizeof(Triangle) == 12);

class SceneHash {
 public:
  template <class T>
  void add(std::span<const T> values, unsigned components = 1) {
    const std::uint64_t count = values.size() / components;  // so that what stands on either side of a border matters
    hash_.add(&count, sizeof count);
    hash_.add(values.data(), values.size_bytes());
  }
  std::string hex() { return hash_.hex(); }

 private:
  support::Sha256 hash_;
};

}  // namespace

std::string sceneHash(const Scene& scene) {
  SceneHash hash;
  hash.add(std::span<const std::uint32_t>(std::array{scene.width, scene.height}));
  // Given clip positions go through no matrix.
  if (scene.clip.empty()) hash.add(std::span<const float>(scene.clipFromObject));
  hash.add(std::span<const glm::vec3>(scene.positions));
  hash.add(std::span<const glm::vec4>(scene.clip));
  const Stream* const normals = scene.stream(kNormals);
  hash.add(normals == nullptr ? std::span<const float>() : normals->values.span(), 3);
  hash.add(std::span<const Triangle>(scene.triangles));
  for (const Stream& stream : scene.streams) {
    if (&stream == normals || stream.values.empty()) continue;
    hash.add(std::span<const char>(stream.name));
    hash.add(stream.values.span(), stream.components);
  }
  if (scene.origin != glm::dvec3(0)) hash.add(std::span<const double>(&scene.origin.x, 3));
  return hash.hex();
}

}  // namespace tessera
