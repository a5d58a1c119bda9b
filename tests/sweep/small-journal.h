#pragma once

#include <string>

namespace tessera::test {

/// The text of a sweep's journal of one cell, checked and sampled once.
std::string smallJournal();

}  // namespace tessera::test
