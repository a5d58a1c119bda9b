#include "experiments/harness/fields.h"

#include <fmt/format.h>

#include <set>

namespace tessera::harness {
namespace {

constexpr std::size_t kLongestKey = 120;  // in a message
constexpr int kDeepest = 64;              // a row has six levels; the library writes and copies a level a call

std::string shortText(const Json& json) {
  if (json.is_object()) return "an object";
  if (json.is_array()) return "a list";
  const std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() <= 40 ? text : text.substr(0, 37) + "...";
}

}  // namespace

Json parsedLine(std::string_view line) {
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  const auto look = [&](int depth, Json::parse_event_t event, Json& value) {
    if (depth > kDeepest) throw WrongField(fmt::format("nested more than {} levels deep", kDeepest));
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second)
      throw WrongField(fmt::format("{}: is there twice", shortText(value)));
    return true;
  };
  try {
    return Json::parse(line.begin(), line.end(), look);
  } catch (const Json::exception&) {
    throw WrongField("is not JSON");
  }
}

void failField(const std::string& key, const Json* found, std::string_view right) {
  const std::string name = key.size() <= kLongestKey ? key : key.substr(0, kLongestKey - 3) + "...";
  throw WrongField(found ? fmt::format("{}: is {}; {} would be right", name, shortText(*found), right)
                         : fmt::format("{}: is missing; {} would be right", name, right));
}

namespace {

/// The member if it is as `is` asks.
template <typename Is>
const Json& checked(const Json& json, const char* key, std::string_view right, Is is) {
  const auto found = json.is_object() ? json.find(key) : json.end();
  if (found == json.end()) failField(key, nullptr, right);
  if (!is(*found)) failField(key, &*found, right);
  return *found;
}

}  // namespace

const Json& member(const Json& json, const char* key) {
  return checked(json, key, "a value", [](const Json&) { return true; });
}

const Json& objectAt(const Json& json, const char* key) {
  return checked(json, key, "an object", [](const Json& j) { return j.is_object(); });
}

const Json& listAt(const Json& json, const char* key) {
  return checked(json, key, "a list", [](const Json& j) { return j.is_array(); });
}

const std::string& textAt(const Json& json, const char* key) {
  return checked(json, key, "text", [](const Json& j) { return j.is_string(); }).get_ref<const std::string&>();
}

bool flagAt(const Json& json, const char* key) {
  return checked(json, key, "true or false", [](const Json& j) { return j.is_boolean(); }).get<bool>();
}

double finiteAt(const Json& json, const char* key) {
  return checked(json, key, "a number from 0 on",
                 [](const Json& j) { return j.is_number() && std::isfinite(j.get<double>()) && j.get<double>() >= 0; })
      .get<double>();
}

std::uint64_t wholeAt(const Json& json, const char* key, std::uint64_t most) {
  return checked(json, key, fmt::format("a whole number up to {}", most),
                 [&](const Json& j) { return j.is_number_unsigned() && j.get<std::uint64_t>() <= most; })
      .get<std::uint64_t>();
}

}  // namespace tessera::harness
