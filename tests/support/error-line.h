// The one line that bad input gets.
#pragma once

#include <tessera/error.h>

#include <functional>
#include <string>

namespace tessera::test {

/// The line of the Error that `action` throws, after checking its code; fails the test if it throws none or says more
/// than a line.
std::string lineOf(ExitCode code, const std::function<void()>& action);

/// Says what was looked for, and in what, where it is not there.
bool contains(const std::string& text, const std::string& part);

}  // namespace tessera::test
