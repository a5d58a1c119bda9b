#include "mutate.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tessera::test {
namespace {

constexpr std::size_t kMost = 1 << 16;  // bytes: a file need not grow to show a fault

class Mutation {
 public:
  Mutation(std::string& text, std::string_view other, datasets::Random& random)
      : text_(text), other_(other), random_(random) {}

  void apply() {
    switch (below(14)) {
      case 0:  // a bit
        if (!text_.empty()) text_[below(text_.size())] ^= static_cast<char>(1u << below(8));
        break;
      case 1:  // a byte
        if (!text_.empty()) text_[below(text_.size())] = byte();
        break;
      case 2:
        text_.insert(text_.begin() + static_cast<std::ptrdiff_t>(below(text_.size() + 1)), byte());
        break;
      case 3:
        replace(part(64), "");
        break;
      case 4:  // a part twice, or in another place
        insert(std::string(slice(text_, part(64))));
        break;
      case 5:
        insert(std::string(slice(other_, partOf(other_.size(), 64))));
        break;
      case 6:
        text_.resize(below(text_.size() + 1));
        break;
      case 7:
      case 8:
        replace(word(), std::string(number()));
        break;
      case 9:  // a word by another one, or by two
        replace(word(), std::string(slice(text_, word())) + (below(4) == 0 ? " 1" : ""));
        break;
      case 10:
        replace(line(), "");
        break;
      case 11:  // a line again, in its place or in another one, perhaps often
        for (std::size_t n = below(8) == 0 ? 200 : 1; n > 0 && text_.size() < kMost; --n)
          insert(std::string(slice(text_, line())));
        break;
      case 12:
        lineEnds();
        break;
      default:
        integer();
    }
    if (text_.size() > kMost) text_.resize(kMost);
  }

 private:
  using Part = std::pair<std::size_t, std::size_t>;  ///< begin and length

  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_.bits() % count; }
  char byte() {
    using namespace std::string_view_literals;
    constexpr std::string_view kTelling = "\0\n\r\t \"'#\\/[]{}=.,-+eE0123456789\x7f\x80\xef\xff"sv;
    return below(2) == 0 ? kTelling[below(kTelling.size())] : static_cast<char>(below(256));
  }
  std::string_view number() {
    constexpr std::array<std::string_view, 28> kNumbers{"0",
                                                        "-0",
                                                        "1",
                                                        "-1",
                                                        "2",
                                                        "3",
                                                        "255",
                                                        "256",
                                                        "32767",
                                                        "32768",
                                                        "65536",
                                                        "2147483647",
                                                        "2147483648",
                                                        "-2147483649",
                                                        "4294967295",
                                                        "4294967296",
                                                        "9223372036854775807",
                                                        "9223372036854775808",
                                                        "18446744073709551616",
                                                        "99999999999999999999999",
                                                        "1e38",
                                                        "3.5e38",
                                                        "1e308",
                                                        "1e999",
                                                        "1e-320",
                                                        "nan",
                                                        "-inf",
                                                        "0x1p3"};
    return kNumbers[below(kNumbers.size())];
  }
  Part partOf(std::size_t size, std::size_t most) {
    const std::size_t begin = below(size);
    return {begin, std::min(size - begin, 1 + below(most))};
  }
  Part part(std::size_t most) { return partOf(text_.size(), most); }
  static std::string_view slice(std::string_view text, const Part& part) {
    return text.substr(part.first, part.second);
  }
  void replace(const Part& part, const std::string& by) { text_.replace(part.first, part.second, by); }
  void insert(const std::string& what) { text_.insert(below(text_.size() + 1), what); }
  Part between(std::string_view borders) {
    const std::size_t at = below(text_.size());
    const std::size_t before = text_.find_last_of(borders, at), begin = before == std::string::npos ? 0 : before + 1;
    return {begin, std::min(text_.find_first_of(borders, begin), text_.size()) - begin};
  }
  Part word() { return between(" \t\r\n,=[]"); }
  Part line() {
    Part part = between("\n");
    if (part.first + part.second < text_.size()) ++part.second;  // with its end
    return part;
  }
  void lineEnds() {
    constexpr std::array<std::string_view, 4> kEnds{"\r", "\r\n", " \n", ""};
    const std::string_view end = kEnds[below(kEnds.size())];
    const bool all = below(2) == 0;
    std::string changed = below(4) == 0 ? "\xef\xbb\xbf" : "";
    for (const char c : text_) {
      if (c == '\n' && (all || below(2) == 0))
        changed += end;
      else
        changed += c;
    }
    text_ = std::move(changed);
  }
  /// Four bytes in either order.
  void integer() {
    if (text_.size() < 4) return;
    constexpr std::array<std::uint32_t, 9> kIntegers{0,          1,          0x7f,       0xff,      0xffff,
                                                     0x7fffffff, 0x80000000, 0xffffffff, 0x7f800000};
    const std::uint32_t value = kIntegers[below(kIntegers.size())];
    const bool big = below(2) == 0;
    const std::size_t at = below(text_.size() - 3);
    for (std::size_t i = 0; i < 4; ++i) text_[at + i] = static_cast<char>(value >> (big ? 24 - 8 * i : 8 * i));
  }

  std::string& text_;
  std::string_view other_;
  datasets::Random& random_;
};

}  // namespace

std::string mutate(std::string text, std::string_view other, datasets::Random& random) {
  Mutation mutation(text, other, random);
  for (auto n = 1 + random.bits() % 6; n > 0; --n) mutation.apply();
  return text;
}

}  // namespace tessera::test
