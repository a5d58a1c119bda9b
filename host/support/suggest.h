// What somebody may have meant: a mistyped word beside the words that there are.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tessera::support {

/// The one of `known` that `typed` is nearest to, "" where none is near: one slip in three letters (a letter missing,
/// added, wrong, or two in the wrong order), or the beginning of a word. Case, `_` for `-` and leading hyphens do not
/// count. Numbers are near to no other number.
std::string nearest(std::string_view typed, const std::vector<std::string>& known);

/// The end of a message that refuses `typed`: "did you mean tile? There are tile, cull", or "there are tile, cull".
std::string whatThereIs(std::string_view typed, const std::vector<std::string>& known);

/// The member `name` of each thing in a list, such as &Axis::name.
template <typename List, typename Member>
std::vector<std::string> namesOf(const List& list, Member name) {
  std::vector<std::string> names;
  for (const auto& thing : list) names.emplace_back(thing.*name);
  return names;
}

}  // namespace tessera::support
