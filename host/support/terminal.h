// Text for a terminal. Names come from files, devices and command lines, and may hold what a terminal obeys.
#pragma once

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace tessera::support {

/// The text with each control character but the line's end and the tab, each sign that turns the direction of writing,
/// and each byte that is not UTF-8 written out: "\u001b", "\u202e", "\xff". Text of JSON stays JSON with the same
/// values.
std::string visible(std::string_view text);

/// Prints to stdout or stderr what people read. Throws std::system_error where stdout takes no more.
template <typename... Arguments>
void say(std::FILE* file, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  const std::string text = visible(fmt::format(format, std::forward<Arguments>(arguments)...));
  if (std::fwrite(text.data(), 1, text.size(), file) != text.size() && file == stdout)
    throw std::system_error(errno, std::generic_category());
}

/// Hands on what stdout still holds. Throws std::system_error, with the cause, where it takes no more: a flush whose
/// failure nobody looks at loses the cause.
inline void flushStdout() {
  if (std::fflush(stdout) != 0) throw std::system_error(errno, std::generic_category());
}

}  // namespace tessera::support
