#pragma once

#include <string>
#include <string_view>

#include "datasets/random.h"

namespace tessera::test {

/// The text with one to six faults: bits, bytes, words, numbers, lines and line ends that are changed, lost, doubled or
/// moved, or an end that comes early. `other` is a file of the same kind, which parts may come from.
std::string mutate(std::string text, std::string_view other, datasets::Random& random);

}  // namespace tessera::test
