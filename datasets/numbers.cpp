#include "datasets/numbers.h"

#include <bit>
#include <charconv>
#include <cmath>

namespace tessera {
namespace {

/// from_chars takes no plus sign, files do.
std::string_view withoutPlus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
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
  // What is too small for a double is a number too; from_chars alone does not tell it from one too large.
  if (error == std::errc::result_out_of_range) {
    long double wide = 0;
    error = std::from_chars(word.data(), word.data() + word.size(), wide).ec;
    value = static_cast<double>(wide);
    if (std::isinf(value)) return std::nullopt;
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

}  // namespace tessera
