#include "datasets/numbers.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>

namespace tessera::datasets {
namespace {

/// from_chars takes no plus sign, files do.
std::string_view withoutPlus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

/// Whether a decimal number that no double can hold is large, not small: by the power of ten of its first digit that
/// is not 0.
bool isLarge(std::string_view number) {
  const std::size_t end = std::min(number.find_first_of("eE"), number.size());
  std::int64_t power = 0;
  bool begun = false, fraction = false;
  for (const char c : number.substr(0, end)) {
    fraction |= c == '.';
    if (c < '0' || c > '9') continue;
    begun |= c != '0';
    power += begun && !fraction ? 1 : !begun && fraction ? -1 : 0;
  }
  if (end == number.size()) return power > 0;
  const std::string_view exponent = withoutPlus(number.substr(end + 1));
  std::int64_t value = 0;
  if (std::from_chars(exponent.data(), exponent.data() + exponent.size(), value).ec == std::errc::result_out_of_range)
    return exponent[0] != '-';
  return power > -value;
}

}  // namespace

std::optional<std::int64_t> toInteger(std::string_view word) {
  word = withoutPlus(word);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::optional<double> toNumber(std::string_view word) {
  word = withoutPlus(word);
  double value = 0;
  auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  // What is too small for a double is a number too; from_chars does not tell it from one too large.
  if (error == std::errc::result_out_of_range) {
    value = std::copysign(isLarge(word) ? HUGE_VAL : 0.0, word[0] == '-' ? -1 : 1);
    error = {};
  }
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::optional<double> toDouble(std::string_view word) {
  const auto value = toNumber(word);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

float nearestFloat(std::string_view word, double value) {
  // Rounding twice differs from rounding once only where the double lies halfway between two floats.
  const auto single = static_cast<float>(value);
  constexpr std::uint64_t kRest = (std::uint64_t{1} << 29) - 1;
  const bool halfway = (std::bit_cast<std::uint64_t>(value) & kRest) == (kRest + 1) / 2;
  if (value == 0) return single;
  if (!halfway && std::fpclassify(single) == FP_NORMAL) return single;
  word = withoutPlus(word);
  float exact = 0;
  const auto error = std::from_chars(word.data(), word.data() + word.size(), exact).ec;
  return error == std::errc{} ? exact : single;
}

std::optional<float> toReal(std::string_view word) {
  const auto value = toNumber(word);
  if (!value) return std::nullopt;
  const float single = nearestFloat(word, *value);
  return std::isfinite(single) ? std::optional(single) : std::nullopt;
}

}  // namespace tessera::datasets
