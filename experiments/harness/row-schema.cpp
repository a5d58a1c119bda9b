#include "experiments/harness/row-schema.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <regex>
#include <stdexcept>

#include "experiments/harness/fields.h"

namespace tessera::harness {

extern const char* const kRowSchemaText;

namespace {

constexpr std::size_t kLongestMatched = 256;  // bytes; std::regex takes a level of the stack a letter

const Json& schema() {
  static const Json parsed = Json::parse(kRowSchemaText);
  return parsed;
}

struct Type {
  const char* text;
  bool (*has)(const Json&);
};

/// A whole number is one that is written as such: the schema would take 8.0, too, and no row has it.
const std::map<std::string, Type>& types() {
  static const std::map<std::string, Type> known{
      {"object", {"an object", [](const Json& j) { return j.is_object(); }}},
      {"array", {"a list", [](const Json& j) { return j.is_array(); }}},
      {"string", {"text", [](const Json& j) { return j.is_string(); }}},
      {"integer", {"a whole number", [](const Json& j) { return j.is_number_integer(); }}},
      {"number", {"a number", [](const Json& j) { return j.is_number(); }}},
      {"boolean", {"true or false", [](const Json& j) { return j.is_boolean(); }}},
      {"null", {"null", [](const Json& j) { return j.is_null(); }}}};
  return known;
}

void check(const Json& value, const Json& rules, const std::string& key);

std::string below(const std::string& key, const std::string& name) { return key.empty() ? name : key + '.' + name; }

void checkType(const Json& value, const Json& wanted, const std::string& key) {
  std::vector<std::string> texts;
  for (const Json& name : wanted.is_array() ? wanted : Json::array({wanted})) {
    const Type& type = types().at(name);
    if (type.has(value)) return;
    texts.emplace_back(type.text);
  }
  failField(key, &value, fmt::format("{}", fmt::join(texts, " or ")));
}

void checkNumber(const Json& value, const std::string& rule, const Json& wanted, const std::string& key) {
  const double number = value, bound = wanted;
  if (rule == "minimum" ? number >= bound : number <= bound) return;
  failField(key, &value, fmt::format("a number {} {:g}", rule == "minimum" ? "from" : "up to", bound));
}

bool matches(const std::string& text, const std::string& pattern) {
  thread_local std::map<std::string, std::regex> made;  // a row has some fifty names to match
  if (text.size() > kLongestMatched) return false;
  return std::regex_search(text, made.try_emplace(pattern, pattern).first->second);
}

void checkText(const Json& value, const std::string& rule, const Json& rules, const std::string& key) {
  const auto& text = value.get_ref<const std::string&>();
  const Json& wanted = rules.at(rule);
  const auto letters = std::ranges::count_if(text, [](unsigned char c) { return (c & 0xc0) != 0x80; });
  if (rule == "maxLength" && letters > wanted.get<std::ptrdiff_t>())
    failField(key, &value, fmt::format("text of at most {} letters", wanted.get<std::ptrdiff_t>()));
  if (rule == "pattern" && !matches(text, wanted.get_ref<const std::string&>()))
    failField(key, &value, rules.at("description").get<std::string>());
}

void checkList(const Json& list, const std::string& rule, const Json& wanted, const std::string& key) {
  if (rule == "items") {
    for (std::size_t i = 0; i < list.size(); ++i) check(list[i], wanted, below(key, std::to_string(i)));
    return;
  }
  const auto count = wanted.get<std::size_t>();
  if (rule == "minItems" ? list.size() < count : list.size() > count)
    failField(key, &list, fmt::format("{} entries", count));
}

void checkObject(const Json& object, const std::string& rule, const Json& rules, const std::string& key) {
  const Json& wanted = rules.at(rule);
  if (rule == "required") {
    for (const std::string name : wanted)
      if (!object.contains(name)) failField(below(key, name), nullptr, "a row that has it");
    return;
  }
  for (const auto& [name, value] : object.items()) {
    if (rule == "propertyNames") check(name, wanted, below(key, name));
    if (rule == "properties" && wanted.contains(name)) check(value, wanted.at(name), below(key, name));
    if (rule == "additionalProperties" && !(rules.contains("properties") && rules.at("properties").contains(name)))
      check(value, wanted, below(key, name));
  }
}

/// What the rule is about; null where it says nothing that can be refused. Of other values it says nothing, either.
const char* subjectOf(const std::string& rule) {
  static const std::map<std::string, const char*> known{{"minimum", "number"},
                                                        {"maximum", "number"},
                                                        {"pattern", "string"},
                                                        {"maxLength", "string"},
                                                        {"items", "array"},
                                                        {"minItems", "array"},
                                                        {"maxItems", "array"},
                                                        {"required", "object"},
                                                        {"properties", "object"},
                                                        {"propertyNames", "object"},
                                                        {"additionalProperties", "object"},
                                                        {"if", nullptr},  // and what hangs on it: see check()
                                                        {"then", nullptr},
                                                        {"else", nullptr},
                                                        {"$schema", nullptr},
                                                        {"title", nullptr},
                                                        {"description", nullptr},
                                                        {"$defs", nullptr}};
  const auto found = known.find(rule);
  if (found == known.end()) throw std::logic_error("row.schema.json: " + rule + ": is not known to row-schema.cpp");
  return found->second;
}

bool fits(const Json& value, const Json& rules) try {
  check(value, rules, "");
  return true;
} catch (const WrongField&) {
  return false;
}

void check(const Json& value, const Json& rules, const std::string& key) {
  if (rules.contains("if")) check(value, rules.at(fits(value, rules.at("if")) ? "then" : "else"), key);
  for (const auto& [rule, wanted] : rules.items()) {
    if (rule == "$ref") {
      check(value, schema().at(Json::json_pointer(wanted.get<std::string>().substr(1))), key);
    } else if (rule == "type") {
      checkType(value, wanted, key);
    } else if (rule == "enum") {
      if (std::ranges::find(wanted, value) == wanted.end())
        failField(key, &value, fmt::format("one of {}", fmt::join(wanted.get<std::vector<std::string>>(), ", ")));
    } else if (const char* const subject = subjectOf(rule); subject && types().at(subject).has(value)) {
      if (value.is_number()) checkNumber(value, rule, wanted, key);
      if (value.is_string()) checkText(value, rule, rules, key);
      if (value.is_array()) checkList(value, rule, wanted, key);
      if (value.is_object()) checkObject(value, rule, rules, key);
    }
  }
}

}  // namespace

void checkSchema(const Json& value, const std::string& part, const std::string& key) {
  check(value, schema().at(Json::json_pointer(part)), key);
}

}  // namespace tessera::harness
