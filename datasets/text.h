// Walking through the lines and words of a text file, with the place at hand for messages.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// The whole file. Throws kUsage when it is missing, a folder, unreadable or empty.
std::string readFile(const std::filesystem::path& path);

class Lines {
 public:
  enum class Comments { kNone, kHash };  ///< kHash: what follows a '#' on a line is left out
  Lines(std::string name, std::string_view text, Comments comments)
      : name_(std::move(name)), text_(text), comments_(comments) {}
  /// Moves to the next line that has words; false at the end.
  bool next();
  /// The same, or a message that the file ends before `what`.
  void need(std::string_view what);
  const std::vector<std::string_view>& words() const { return words_; }
  std::size_t at() const { return std::min(at_, text_.size()); }  ///< bytes up to the end of the line
  /// A line that ends in a backslash goes on in the next one.
  void joinContinued() { continued_ = true; }
  [[noreturn]] void fail(std::string_view wrong) const;  ///< kUsage: "file:line: wrong"

  /// Word `i` of the line as a finite float32 / an integer that fits; a message names `what` otherwise.
  float real(std::size_t i, std::string_view what) const;
  std::int64_t integer(std::size_t i, std::string_view what, std::int64_t least, std::int64_t most) const;
  std::string_view word(std::size_t i, std::string_view what) const;

 private:
  bool takeLine();

  std::string name_;
  std::string_view text_;
  Comments comments_;
  std::size_t at_ = 0, number_ = 0;
  bool continued_ = false;
  std::string joined_;
  std::vector<std::string_view> words_;
};

/// ASCII letters made small.
std::string lowerCase(std::string_view text);

/// The whole word as an integer, if it is one that fits.
std::optional<std::int64_t> toInteger(std::string_view word);
/// The whole word as a finite double, if it is one.
std::optional<double> toDouble(std::string_view word);
/// The whole word as a finite float32, if it is one.
std::optional<float> toReal(std::string_view word);

}  // namespace tessera
