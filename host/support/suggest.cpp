#include "host/support/suggest.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace tessera::support {
namespace {

std::string plain(std::string_view word) {
  word.remove_prefix(std::min(word.find_first_not_of('-'), word.size()));
  std::string text;
  for (const unsigned char c : word) text += c == '_' ? '-' : static_cast<char>(std::tolower(c));
  return text;
}

/// Slips between two words: Damerau's, CACM 1964, in its restricted form.
std::size_t slips(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, last(b.size() + 1), now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before = last;
    last = now;
  }
  return last[b.size()];
}

}  // namespace

std::string nearest(std::string_view typed, const std::vector<std::string>& known) {
  // What a stranger typed may be as long as a command line, and no word that there is comes near it.
  constexpr std::size_t kLongest = 100;
  const std::string word = plain(typed);
  if (word.empty() || word.size() > kLongest) return "";
  if (std::ranges::all_of(word, [](unsigned char c) { return std::isdigit(c) || c == '.'; })) return "";
  std::string best;
  std::size_t fewest = kLongest;
  for (const std::string& name : known) {
    const std::string candidate = plain(name);
    if (candidate.empty()) continue;
    const std::size_t count = slips(word, candidate);
    if (count <= std::max(word.size(), candidate.size()) / 3 && count < fewest) best = name, fewest = count;
  }
  if (!best.empty() || word.size() < 2) return best;
  const auto begun =
      std::ranges::find_if(known, [&](const std::string& name) { return plain(name).starts_with(word); });
  return begun == known.end() ? "" : *begun;
}

std::string whatThereIs(std::string_view typed, const std::vector<std::string>& known) {
  if (known.empty()) return "there are none";
  const std::string meant = nearest(typed, known), list = fmt::format("{}", fmt::join(known, ", "));
  const char* const verb = known.size() == 1 ? "is" : "are";
  return meant.empty() ? fmt::format("there {} {}", verb, list)
                       : fmt::format("did you mean {}? There {} {}", meant, verb, list);
}

}  // namespace tessera::support
