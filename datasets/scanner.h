// Walking through the words and lines of a text, with the place at hand for messages. Every text format of this folder
// is read by it: a line ends with LF, CR or CR LF, in any mixture.
#pragma once

#include <tessera/input.h>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "datasets/numbers.h"

namespace tessera::datasets {

/// A file in memory, under the name that messages give it.
struct FileText {
  const std::string& name;
  std::string_view text;
  const ReadProgress& progress;
};

class Scanner {
 public:
  enum class Syntax : std::uint8_t {
    kPlain,
    kHash,             ///< what follows a '#' on a line is a comment
    kHashAndBackslash  ///< and a line that ends in a backslash goes on in the next one
  };
  Scanner(const FileText& file, Syntax syntax);

  /// Leaves the rest of the line and goes to the next one that has words; false at the end of the text. The first call
  /// goes to the first such line.
  bool line();
  /// Leaves the rest of a line that is not read. A backslash at its end belongs to a name, such as a folder's, and the
  /// line ends there, if the next line begins with a word that `begins` a line of its own.
  void leaveLine(bool (*begins)(std::string_view));
  /// Goes to the next word of this line; false at the line's end.
  bool more() {
    const char* p = at_;
    while (p != end_ && kind(p) == Kind::kBlank) ++p;
    return p != end_ && kind(p) == Kind::kWord ? begins(p) : moreRare();
  }
  /// Goes to the next word, on this line or a later one; false at the end of the text.
  bool ahead() {
    const char* p = at_;
    while (p < report_ && (kind(p) == Kind::kBlank || kind(p) == Kind::kLineEnd)) ++p;
    return p < report_ && kind(p) == Kind::kWord ? begins(p) : aheadRare();
  }
  /// The same, or a message that the text ends early, "the file ends before what".
  void needAhead(std::string_view what);

  /// The word here, which must be there: more() or ahead() was true. The number functions take the word as a number;
  /// `what` is its name in messages.
  std::string_view word();
  /// Infinite and NaN, too. One too large for what it is taken as is refused in the words of `beyond`.
  double number(std::string_view what, std::string_view beyond = "is beyond float64");
  double real(std::string_view what);          ///< finite, in float32, too
  float single(std::string_view what);         ///< a float32, infinite and NaN, too
  std::int64_t integer(std::string_view what,  ///< of this range; it may be written as a real, 3.0
                       std::int64_t least = INT64_MIN, std::int64_t most = INT64_MAX);
  /// The next word of this line; a message if there is none.
  std::string_view wordInLine(std::string_view what);
  /// What is left of this line, without blanks at its ends.
  std::string_view rest();

  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }  ///< bytes
  std::size_t at() const { return static_cast<std::size_t>(at_ - begin_); }
  void moveTo(std::size_t at) { at_ = place_ = begin_ + at; }
  /// kUsage: "file:line: wrong", at the line of the last word.
  [[noreturn]] void fail(std::string_view wrong) const;

 private:
  enum class Kind : std::uint8_t { kWord, kBlank, kLineEnd, kComment, kBackslash };
  using Kinds = std::array<Kind, 256>;
  static const Kinds& kindsOf(Syntax syntax);

  Kind kind(const char* p) const { return kinds_[static_cast<unsigned char>(*p)]; }
  /// Length of the line's end after a backslash here; 0 where it is a character like others.
  std::size_t continued(const char* p) const;
  bool wordEndsAt(const char* p) const {
    return p == end_ || (kind(p) != Kind::kWord && (kind(p) != Kind::kBackslash || continued(p) != 0));
  }
  std::string_view wordAt(const char* p) const;
  bool begins(const char* word) {
    at_ = place_ = word;
    return true;
  }
  /// more() and ahead() where the next thing is no word, or progress is due.
  bool moreRare();
  bool aheadRare();
  void skipBlanks();
  void skipLine();
  double slowNumber(std::string_view what, std::string_view beyond);
  void report();

  const FileText& file_;
  const Kinds& kinds_;
  const char *begin_, *end_, *at_, *place_;  ///< place_: where the last word begins
  const char* report_;                       ///< from here on progress is due; at most end_
  bool started_ = false;
};

}  // namespace tessera::datasets
