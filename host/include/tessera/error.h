// How failures leave the library: one exception type that carries the documented exit code.
#pragma once

#include <stdexcept>
#include <string>

namespace tessera {

/// Exit codes of the command line; a library user switches on them.
enum class ExitCode : int {
  kDone = 0,           ///< all was done
  kFailure = 1,        ///< anything that has no code of its own
  kUsage = 2,          ///< bad usage or input, a device that is not there included
  kOverflow = 3,       ///< a capacity was exceeded under overflow=error
  kUnsupported = 4,    ///< the device cannot run this variant; the message names the missing feature
  kDifference = 5,     ///< compare or parity found a difference
  kInterrupted = 130,  ///< sweep was stopped by Ctrl-C or SIGTERM; what it had is kept
};

/// The one exception of the library. Its `what()` is one line: file, place, what is wrong, what would be right.
class Error : public std::runtime_error {
 public:
  /// `line`: one line without a line break at its end.
  Error(ExitCode code, const std::string& line) : std::runtime_error(line), code_(code) {}
  /// The kind of failure, as an exit code.
  ExitCode code() const noexcept { return code_; }

 private:
  ExitCode code_;
};

/// Throws Error with ExitCode::kUsage: what was asked for, or an input, is wrong.
[[noreturn]] inline void failUsage(const std::string& line) { throw Error(ExitCode::kUsage, line); }
/// Throws Error with ExitCode::kUnsupported: the device cannot do what was asked for.
[[noreturn]] inline void failUnsupported(const std::string& line) { throw Error(ExitCode::kUnsupported, line); }
/// Throws Error with ExitCode::kFailure: any other failure.
[[noreturn]] inline void fail(const std::string& line) { throw Error(ExitCode::kFailure, line); }

}  // namespace tessera
