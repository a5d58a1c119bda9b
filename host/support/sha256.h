// SHA-256 (FIPS 180-4), by libcrypto.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace tessera::support {

/// Of bytes that come one after another. Throws kFailure where libcrypto has none.
class Sha256 {
 public:
  Sha256();
  void add(const void* bytes, std::size_t count);
  /// 64 hexadecimal digits; asked for once, at the end.
  std::string hex();

 private:
  struct Free {
    void operator()(void* context) const;
  };
  std::unique_ptr<void, Free> context_;
};

/// The same of one text.
std::string sha256(std::string_view text);

}  // namespace tessera::support
