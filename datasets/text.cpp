#include "datasets/text.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>

#include "host/error.h"

namespace tessera {
namespace {

/// from_chars takes no plus sign, files do.
std::string_view withoutPlus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

void splitWords(std::string_view line, std::vector<std::string_view>& words) {
  constexpr std::string_view kSpace = " \t\r\v\f";
  for (std::size_t begin = line.find_first_not_of(kSpace); begin != line.npos;) {
    const std::size_t end = std::min(line.find_first_of(kSpace, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kSpace, end);
  }
}

}  // namespace

std::string readFile(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) failUsage(fmt::format("{}: no such file", path.string()));
  if (std::filesystem::is_directory(status))
    failUsage(fmt::format("{}: is a folder; a file would be right", path.string()));
  std::ifstream file(path, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(file), {});
  if (!file) failUsage(fmt::format("{}: cannot be read", path.string()));
  if (text.empty()) failUsage(fmt::format("{}: is empty", path.string()));
  return text;
}

bool Lines::takeLine() {
  if (at_ >= text_.size()) return false;
  std::string_view line;
  for (bool more = true; more && at_ < text_.size();) {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++number_;
    if (comments_ == Comments::kHash) line = line.substr(0, line.find('#'));
    while (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    more = continued_ && !line.empty() && line.back() == '\\';
    if (more) line.remove_suffix(1);
    if (more || !joined_.empty()) joined_.append(line).push_back(' ');
  }
  splitWords(joined_.empty() ? line : joined_, words_);
  return true;
}

bool Lines::next() {
  do {
    words_.clear();
    joined_.clear();
    if (!takeLine()) return false;
  } while (words_.empty());
  return true;
}

void Lines::need(std::string_view what) {
  if (!next()) fail(fmt::format("the file ends before {}", what));
}

void Lines::fail(std::string_view wrong) const { failUsage(fmt::format("{}:{}: {}", name_, number_, wrong)); }

std::string_view Lines::word(std::size_t i, std::string_view what) const {
  if (i >= words_.size()) fail(fmt::format("{} is missing", what));
  return words_[i];
}

float Lines::real(std::size_t i, std::string_view what) const {
  const std::string_view text = word(i, what);
  const auto value = toReal(text);
  if (!value) fail(fmt::format("{}: '{}' is not a finite number", what, text));
  return *value;
}

std::int64_t Lines::integer(std::size_t i, std::string_view what, std::int64_t least, std::int64_t most) const {
  const std::string_view text = word(i, what);
  const auto value = toInteger(text);
  if (!value || *value < least || *value > most)
    fail(fmt::format("{}: '{}' is not a whole number from {} to {}", what, text, least, most));
  return *value;
}

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

std::optional<std::int64_t> toInteger(std::string_view word) {
  word = withoutPlus(word);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::optional<double> toDouble(std::string_view word) {
  word = withoutPlus(word);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<float> toReal(std::string_view word) {
  word = withoutPlus(word);
  float value = 0;
  auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  // What is too small for float32 is a number too (0 or a denormal); from_chars alone does not tell it from one too
  // large.
  if (error == std::errc::result_out_of_range) {
    double wide = 0;
    error = std::from_chars(word.data(), word.data() + word.size(), wide).ec;
    value = static_cast<float>(wide);
  }
  if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace tessera
