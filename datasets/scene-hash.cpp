#include <fmt/format.h>
#include <openssl/evp.h>
#include <tessera/error.h>
#include <tessera/input.h>

#include <array>
#include <bit>
#include <memory>
#include <span>

namespace tessera {
namespace {

static_assert(std::endian::native == std::endian::little, "the hash is of little-endian words");
static_assert(sizeof(glm::vec3) == 12 && sizeof(glm::vec4) == 16 && sizeof(Triangle) == 12);

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    check(EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr));
  }
  template <class T>
  void add(std::span<const T> values) {
    const std::uint64_t count = values.size();  // so that what stands on either side of a border matters
    check(EVP_DigestUpdate(context_.get(), &count, sizeof count));
    check(EVP_DigestUpdate(context_.get(), values.data(), values.size_bytes()));
  }
  std::string hex() {
    std::array<unsigned char, 32> digest;
    check(EVP_DigestFinal_ex(context_.get(), digest.data(), nullptr));
    std::string text;
    for (const unsigned char byte : digest) text += fmt::format("{:02x}", byte);
    return text;
  }

 private:
  static void check(int done) {
    if (done != 1) fail("SHA-256 of a scene failed in libcrypto");
  }
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

std::string sceneHash(const Scene& scene) {
  Sha256 hash;
  hash.add(std::span<const std::uint32_t>(std::array{scene.width, scene.height}));
  // Given clip positions go through no matrix.
  if (scene.clip.empty()) hash.add(std::span<const float>(scene.clipFromObject));
  hash.add(std::span<const glm::vec3>(scene.positions));
  hash.add(std::span<const glm::vec4>(scene.clip));
  hash.add(std::span<const glm::vec3>(scene.normals));
  hash.add(std::span<const Triangle>(scene.triangles));
  if (!scene.attribute.empty()) {
    hash.add(std::span<const char>(scene.attributeName));
    hash.add(std::span<const float>(scene.attribute));
  }
  if (scene.origin != glm::dvec3(0)) hash.add(std::span<const double>(&scene.origin.x, 3));
  return hash.hex();
}

}  // namespace tessera
