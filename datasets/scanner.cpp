#include "datasets/scanner.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>
#include <cmath>

#include "datasets/text.h"

namespace tessera::datasets {
namespace {

constexpr std::size_t kReportEvery = 1 << 20;  // bytes
constexpr std::string_view kBeyondFloat = "is beyond float32", kNoReal = "is not a finite number of float32";

}  // namespace

const Scanner::Kinds& Scanner::kindsOf(Syntax syntax) {
  static const auto make = [](Syntax of) {
    Kinds kinds{};
    for (const char blank : {' ', '\t', '\v', '\f'}) kinds[static_cast<unsigned char>(blank)] = Kind::kBlank;
    for (const char end : {'\n', '\r'}) kinds[static_cast<unsigned char>(end)] = Kind::kLineEnd;
    if (of != Syntax::kPlain) kinds['#'] = Kind::kComment;
    if (of == Syntax::kHashAndBackslash) kinds['\\'] = Kind::kBackslash;
    return kinds;
  };
  static const std::array<Kinds, 3> all{make(Syntax::kPlain), make(Syntax::kHash), make(Syntax::kHashAndBackslash)};
  return all[static_cast<std::size_t>(syntax)];
}

Scanner::Scanner(const FileText& file, Syntax syntax)
    : file_(file),
      kinds_(kindsOf(syntax)),
      begin_(file.text.data()),
      end_(begin_ + file.text.size()),
      at_(begin_),
      place_(begin_),
      report_(begin_) {}

void Scanner::report() {
  if (file_.progress) file_.progress(at(), file_.text.size());
  report_ += std::min(kReportEvery + at() - static_cast<std::size_t>(report_ - begin_),
                      static_cast<std::size_t>(end_ - report_));
}

std::size_t Scanner::continued(const char* p) const {
  if (p + 1 == end_ || kind(p + 1) != Kind::kLineEnd) return 0;
  return p[1] == '\r' && p + 2 != end_ && p[2] == '\n' ? 2 : 1;
}

std::string_view Scanner::wordAt(const char* p) const {
  const char* end = p;
  while (!wordEndsAt(end)) ++end;
  return {p, static_cast<std::size_t>(end - p)};
}

void Scanner::skipBlanks() {
  while (at_ != end_) {
    const Kind here = kind(at_);
    const std::size_t over = here == Kind::kBackslash ? continued(at_) : 0;
    if (here != Kind::kBlank && over == 0) return;
    at_ += 1 + over;
  }
}

void Scanner::skipLine() {
  while (at_ != end_ && kind(at_) != Kind::kLineEnd && kind(at_) != Kind::kComment)
    at_ += 1 + (kind(at_) == Kind::kBackslash ? continued(at_) : 0);
  // A comment goes to the end of its line, backslash or not.
  while (at_ != end_ && kind(at_) != Kind::kLineEnd) ++at_;
}

void Scanner::leaveLine(bool (*begins)(std::string_view)) {
  for (; at_ != end_ && kind(at_) != Kind::kLineEnd && kind(at_) != Kind::kComment; ++at_) {
    const std::size_t over = kind(at_) == Kind::kBackslash ? continued(at_) : 0;
    if (over == 0) continue;
    const char* next = at_ + 1 + over;
    while (next != end_ && kind(next) == Kind::kBlank) ++next;
    if (begins(wordAt(next))) {
      ++at_;
      return;
    }
    at_ += over;
  }
}

bool Scanner::moreRare() {
  skipBlanks();
  const bool there = at_ != end_ && kind(at_) != Kind::kLineEnd && kind(at_) != Kind::kComment;
  if (there) place_ = at_;
  return there;
}

bool Scanner::aheadRare() {
  if (at_ >= report_) report();
  while (!more()) {
    skipLine();
    if (at_ == end_) return false;
    ++at_;
  }
  return true;
}

bool Scanner::line() {
  if (started_) skipLine();
  started_ = true;
  return ahead();
}

void Scanner::needAhead(std::string_view what) {
  if (!ahead()) fail(fmt::format("the file ends before {}", what));
}

std::string_view Scanner::word() {
  place_ = at_;
  const std::string_view word = wordAt(at_);
  at_ += word.size();
  return word;
}

std::string_view Scanner::wordInLine(std::string_view what) {
  if (!more()) fail(fmt::format("{} is missing", what));
  return word();
}

std::string_view Scanner::rest() {
  if (!more()) return {};
  const char* const first = at_;
  skipLine();
  const char* last = at_;
  while (last != first && kind(last - 1) == Kind::kBlank) --last;
  return {first, static_cast<std::size_t>(last - first)};
}

double Scanner::slowNumber(std::string_view what, std::string_view beyond) {
  const std::string_view text = word();
  const auto value = toNumber(text);
  if (!value) fail(fmt::format("{}: {} is not a number", what, shown(text)));
  const bool digits = text.find_first_of("0123456789") != std::string_view::npos;  // no word for infinity has any
  if (digits && std::isinf(*value)) fail(fmt::format("{}: {} {}", what, shown(text), beyond));
  return *value;
}

double Scanner::number(std::string_view what, std::string_view beyond) {
  const char* p = at_;
  double value = 0;
  if (!takeShortDecimal(p, end_, value) || !wordEndsAt(p)) return slowNumber(what, beyond);
  at_ = p;
  return value;
}

float Scanner::single(std::string_view what) {
  const char* const first = at_;
  const double value = number(what, kBeyondFloat);
  const std::string_view text(first, static_cast<std::size_t>(at_ - first));
  const float single = nearestFloat(text, value);
  if (std::isinf(single) && !std::isinf(value)) fail(fmt::format("{}: {} {}", what, shown(text), kBeyondFloat));
  return single;
}

double Scanner::real(std::string_view what) {
  const char* const first = at_;
  const double value = number(what, kNoReal);
  if (!std::isfinite(static_cast<float>(value)))
    fail(fmt::format("{}: {} {}", what, shown({first, static_cast<std::size_t>(at_ - first)}),
                     std::isfinite(value) ? kNoReal : "is not a finite number"));
  return value;
}

std::int64_t Scanner::integer(std::string_view what, std::int64_t least, std::int64_t most) {
  const char* p = at_;
  const bool negative = p != end_ && *p == '-';
  p += negative;
  const char* const first = p;
  std::int64_t value = 0;
  while (p != end_ && static_cast<unsigned char>(*p - '0') < 10 && p - first < 18) value = 10 * value + (*p++ - '0');
  if (p == first || !wordEndsAt(p)) {
    const std::string_view text = wordAt(at_);
    const auto whole = toInteger(text);
    const auto real = whole ? std::nullopt : toDouble(text);
    const bool fits = real && *real == std::floor(*real) && std::abs(*real) <= 9007199254740992.0;
    if (!whole && !fits) fail(fmt::format("{}: {} is not a whole number", what, shown(text)));
    value = whole ? *whole : static_cast<std::int64_t>(*real);
    p = at_ + text.size();
  } else if (negative) {
    value = -value;
  }
  if (value < least || value > most)
    fail(fmt::format("{}: {} is not a whole number from {} to {}", what, shown(wordAt(at_)), least, most));
  at_ = p;
  return value;
}

void Scanner::fail(std::string_view wrong) const {
  // Counted here alone: reading itself needs no line numbers.
  std::size_t line = 1;
  for (const char* p = begin_; p != place_; ++p) line += *p == '\n' ? p == begin_ || p[-1] != '\r' : *p == '\r';
  failUsage(fmt::format("{}:{}: {}", file_.name, line, wrong));
}

}  // namespace tessera::datasets
