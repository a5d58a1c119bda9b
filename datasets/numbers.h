// Numbers in text, exact: a decimal gives the nearest double, and a word that is not wholly a number gives nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace tessera::datasets {

/// The whole word as an integer, if it is one that fits.
std::optional<std::int64_t> toInteger(std::string_view word);
/// The whole word as a double; what is too small for one is 0, what is too large infinite. Infinities and NaN count as
/// numbers here.
std::optional<double> toNumber(std::string_view word);
/// The whole word as a finite double, if it is one.
std::optional<double> toDouble(std::string_view word);
/// The whole word as a finite float32, if it is one.
std::optional<float> toReal(std::string_view word);
/// The float32 nearest to the word, which is a number whose nearest double is `value`.
float nearestFloat(std::string_view word, double value);

/// The number at the beginning of [at, end) as most files write it: a sign, digits with a point, a short exponent. True
/// if it is exact, with `at` moved past it; else toNumber() of the word has the answer.
inline bool takeShortDecimal(const char*& at, const char* end, double& value) {
  // Clinger 1990: an integer below 2^53, and a power of ten up to 10^22, are doubles, so one rounding makes the result.
  static constexpr double kPowers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                       1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  const auto digit = [&](const char* p) { return p != end && static_cast<unsigned char>(*p - '0') < 10; };
  const char* p = at;
  const bool negative = p != end && *p == '-';
  if (p != end && (*p == '-' || *p == '+')) ++p;
  std::uint64_t digits = 0;
  const char* const first = p;
  while (digit(p)) digits = 10 * digits + static_cast<unsigned char>(*p++ - '0');
  std::ptrdiff_t count = p - first, exponent = 0;
  if (p != end && *p == '.') {
    const char* const fraction = ++p;
    while (digit(p)) digits = 10 * digits + static_cast<unsigned char>(*p++ - '0');
    exponent = fraction - p;
    count -= exponent;
  }
  if (count == 0 || count > 19) return false;  // 19 digits fit 64 bits
  if (p != end && (*p == 'e' || *p == 'E')) {
    ++p;
    const bool down = p != end && *p == '-';
    if (p != end && (*p == '-' || *p == '+')) ++p;
    std::ptrdiff_t power = 0;
    const char* const begin = p;
    while (digit(p) && power < 1000) power = 10 * power + (*p++ - '0');
    if (p == begin) return false;
    exponent += down ? -power : power;
  }
  if (digits > (std::uint64_t{1} << 53) || exponent < -22 || exponent > 22) return false;
  const double magnitude =
      exponent < 0 ? static_cast<double>(digits) / kPowers[-exponent] : static_cast<double>(digits) * kPowers[exponent];
  value = negative ? -magnitude : magnitude;
  at = p;
  return true;
}

}  // namespace tessera::datasets
