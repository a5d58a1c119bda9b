// Values of JSON that comes from elsewhere: a journal, a row, another process. What is not as it should be is said with
// its key, and with what would be right.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "experiments/harness/request.h"

namespace tessera::harness {

/// One line, without the file: "round: is -1; a whole number up to 4 would be right".
struct WrongField : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The value of a line of JSON. Throws WrongField, also for a key that is there twice, and for one that is nested too
/// deeply to be copied or written safely.
Json parsedLine(std::string_view line);

[[noreturn]] void failField(const std::string& key, const Json* found, std::string_view right);
const Json& member(const Json& json, const char* key);
const Json& objectAt(const Json& json, const char* key);
const Json& listAt(const Json& json, const char* key);
const std::string& textAt(const Json& json, const char* key);
bool flagAt(const Json& json, const char* key);
double finiteAt(const Json& json, const char* key);  ///< not negative
std::uint64_t wholeAt(const Json& json, const char* key, std::uint64_t most);

template <typename T>
T wholeAt(const Json& json, const char* key) {
  return static_cast<T>(wholeAt(json, key, std::numeric_limits<T>::max()));
}

}  // namespace tessera::harness
