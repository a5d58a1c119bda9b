#include "host/support/sha256.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openssl/evp.h>
#include <tessera/error.h>

#include <array>

namespace tessera::support {
namespace {

EVP_MD_CTX* own(void* context) { return static_cast<EVP_MD_CTX*>(context); }

void check(int done) {
  if (done != 1) fail("SHA-256 failed in libcrypto");
}

}  // namespace

void Sha256::Free::operator()(void* context) const { EVP_MD_CTX_free(own(context)); }

Sha256::Sha256() : context_(EVP_MD_CTX_new()) { check(EVP_DigestInit_ex(own(context_.get()), EVP_sha256(), nullptr)); }

void Sha256::add(const void* bytes, std::size_t count) { check(EVP_DigestUpdate(own(context_.get()), bytes, count)); }

std::string Sha256::hex() {
  std::array<unsigned char, 32> digest{};
  check(EVP_DigestFinal_ex(own(context_.get()), digest.data(), nullptr));
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

std::string sha256(std::string_view text) {
  Sha256 hash;
  hash.add(text.data(), text.size());
  return hash.hex();
}

}  // namespace tessera::support
