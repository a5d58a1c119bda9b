#include "host/kernels/compiler-tools.h"

#include <fmt/format.h>
#include <tessera/error.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "host/kernels/spirv.h"
#include "host/support/files.h"
#include "host/support/home.h"
#include "host/support/own-files.h"
#include "host/support/subprocess.h"
#include "host/support/text.h"

#ifndef TESSERA_CXX
#define TESSERA_CXX "g++"
#endif

namespace tessera::kernels {
namespace {

namespace fs = std::filesystem;

/// The same program until it is replaced; symbolic links are followed.
std::string identity(const fs::path& program) {
  std::error_code error;
  const fs::path real = fs::canonical(program, error);
  const auto size = fs::file_size(real, error);
  const auto time = fs::last_write_time(real, error).time_since_epoch().count();
  return error ? "" : fmt::format("{}|{}|{}", real.string(), size, time);
}

std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

std::string run(const std::vector<std::string>& arguments) {
  const support::ProcessResult result = support::runProcess(arguments);
  if (!result.ok())
    fail(fmt::format("'{}' ended with {} and {}", fmt::join(arguments, " "),
                     result.status > 128 ? fmt::format("signal {}", result.status - 128)
                                         : fmt::format("exit status {}", result.status),
                     result.output.empty() ? "printed nothing" : "printed: " + firstLine(result.output)));
  return result.output;
}

/// Sums, products and quotients, scalar and vector, whose NoContraction an older slangc forgets.
constexpr const char* kProbeModule = R"(RWStructuredBuffer<float> values;
[shader("compute")] [numthreads(1, 1, 1)]
void probe(uint3 group : SV_GroupID)
{
    const uint i = group.x * 8;
    values[i] = values[i + 1] * values[i + 2] + values[i + 3];
    values[i + 4] = (values[i + 5] - values[i + 6] * values[i]) / values[i + 7];
    const float2 pair = float2(values[i], values[i + 1]) * values[i + 2] + float2(values[i + 3], values[i + 5]);
    values[i + 7] = pair.x - pair.y;
}
)";

/// Throws unless this slangc will do. Only a pass is remembered: a missing optimiser may be put beside it at any time.
std::string checkSlangc(const fs::path& slangc) {
  const support::TemporaryFolder work(support::temporaryRoot(), "tessera-slangc");
  const fs::path source = work.path() / "probe.slang", module = work.path() / "probe.spv";
  support::writeInto(source, kProbeModule);
  const support::ProcessResult result =
      support::runProcess({slangc.string(), source.string(), "-target", "spirv", "-O1", "-fp-mode", "precise", "-entry",
                           "probe", "-stage", "compute", "-o", module.string()},
                          work.path());
  if (!result.ok() || !fs::exists(module)) support::checkWritten(work.path(), result.output);
  if (!result.ok() || !fs::exists(module)) fail("cannot compile a small kernel to SPIR-V: " + firstLine(result.output));
  std::vector<std::string> violations;
  try {
    violations = tessera::checkSpirv(module);
  } catch (const Error&) {
    support::checkWritten(work.path(), "");  // slangc says nothing of a file that it could not write to its end
    throw;
  }
  if (!violations.empty()) fail("its SPIR-V is not exact: " + violations[0]);
  return "passed";
}

/// Model and feature flags of this processor: a home folder may be shared by machines that resolve -march=native
/// differently.
const std::string& processorIdentity() {
  static const std::string text = [] {
    std::ifstream file("/proc/cpuinfo");
    std::string all;
    for (std::string line; std::getline(file, line);) {
      if (line.rfind("model name", 0) == 0) all += line;
      if (line.rfind("flags", 0) == 0 || line.rfind("Features", 0) == 0) return all + line;
    }
    return all;
  }();
  return text;
}

}  // namespace

ToolMemory::ToolMemory(const fs::path& folder) : file_(folder / "tools.json") {
  support::checkOwn(folder);
  support::checkOwn(file_);
  std::error_code none;
  if (!fs::is_regular_file(file_, none)) return;  // a folder is replaced by the first answer
  std::ifstream file(file_);
  const nlohmann::json stored = nlohmann::json::parse(file, nullptr, false);
  if (!stored.is_object()) return;  // none yet, or broken: ask again
  for (const auto& [question, answer] : stored.items())
    if (answer.is_string()) answers_[question] = answer;
}

std::string ToolMemory::recall(const std::string& question, const fs::path& program,
                               const std::function<std::string()>& ask) {
  const std::string key = question + "|" + identity(program);
  const std::lock_guard lock(mutex_);
  if (const auto known = answers_.find(key); known != answers_.end()) return known->second;
  const std::string answer = answers_[key] = ask();
  try {
    support::makeOwnFolder(file_.parent_path());
    support::writeOwn(file_, nlohmann::json(answers_).dump(1));
  } catch (const std::system_error&) {
    // it is asked again next time; where nothing can be kept, the kernels say so
  }
  return answer;
}

ToolInfo chooseSlangc(ToolMemory& memory, const fs::path& pinned) {
  const auto fault = [&](const fs::path& path) -> std::string {
    try {
      memory.recall("check", path, [&] { return checkSlangc(path); });
      return "";
    } catch (const support::WriteError&) {
      throw;
    } catch (const support::ShortageError&) {
      throw;
    } catch (const Error& error) {
      return error.what();
    }
  };
  const auto chosen = [&](const fs::path& path, const char* origin) {
    return ToolInfo{path,
                    memory.recall("version", path,
                                  [&] {
                                    return firstLine(run({path.string(), "-version"}));
                                  }),
                    origin};
  };
  const std::string wanted = support::environment("SLANGC");
  if (!wanted.empty()) {
    const fs::path path = support::findProgram(wanted);
    if (path.empty() || access(path.c_str(), X_OK) != 0 || fs::is_directory(path))
      failUsage(fmt::format(
          "SLANGC={}: no such program; name a slangc, or unset it to use PATH's or the one that ./dev fetches",
          wanted));
    if (const std::string why = fault(path); !why.empty())
      failUsage(fmt::format("SLANGC={}: {}; Slang 2026.14.1 or later with its optimiser would do, or unset SLANGC",
                            wanted, why));
    return chosen(path, "SLANGC");
  }
  std::string rejected;
  if (const fs::path path = support::findProgram("slangc"); !path.empty()) {
    const std::string why = fault(path);
    if (why.empty()) return chosen(path, "PATH");
    rejected = fmt::format(" ({} in PATH: {})", path.string(), why);
  }
  if (access(pinned.c_str(), X_OK) != 0)
    failUsage(support::home().installed
                  ? fmt::format("no slangc{}: {} is not there; set SLANGC to a slangc of Slang 2026.14.1 or later, or "
                                "install again from a clone in which `./dev build` ran",
                                rejected, pinned.string())
                  : fmt::format("no slangc{}: `./dev build` fetches one, or set SLANGC to yours", rejected));
  if (const std::string why = fault(pinned); !why.empty())
    failUsage(fmt::format("{}: {}; remove it and run `./dev build`, or set SLANGC to yours", pinned.string(), why));
  return chosen(pinned, "tools");
}

CxxInfo resolveCxx(ToolMemory& memory) {
  CxxInfo info;
  const std::string chosen = support::environment("TESSERA_CXX"), wanted = chosen.empty() ? TESSERA_CXX : chosen;
  info.path = support::findProgram(wanted);
  if (info.path.empty() || access(info.path.c_str(), X_OK) != 0)
    failUsage(chosen.empty()
                  ? fmt::format("{}: no C++ compiler is there, and kernels for the CPU need one: install it (Debian: "
                                "g++), or set TESSERA_CXX to yours",
                                wanted)
                  : fmt::format("TESSERA_CXX={}: no such program; a g++ or clang++ would be right", chosen));
  const std::string compiler = info.path.string();
  const std::string machine = "|" + processorIdentity();
  info.targetMacros = memory.recall("macros" + machine, info.path, [&] {
    const std::vector<std::string> question{compiler, "-march=native", "-dM", "-E", "-x", "c++", "/dev/null"};
    const std::string named = chosen.empty() ? wanted : "TESSERA_CXX=" + chosen;
    std::string why;
    try {
      std::string macros = run(question);
      if (macros.find("#define __cplusplus ") != std::string::npos) return macros;
      why = fmt::format("'{}' names no macro __cplusplus", fmt::join(question, " "));
    } catch (const support::ShortageError&) {
      throw;
    } catch (const Error& error) {
      why = error.what();
    }
    failUsage(fmt::format("{}: no C++ compiler that will do: {}; a g++ or clang++ would be right", named, why));
  });
  const std::string version = memory.recall("version", info.path, [&] {
    return firstLine(run({compiler, "--version"}));
  });
  const bool clang =
      info.targetMacros.find("#define __clang__ ") != std::string::npos;  // c++ and cc1plus wrappers hide who they are
  info.version = (clang ? "clang++ " : "g++ ") + version.substr(version.find_last_of(' ') + 1);
  info.target = memory.recall("target" + machine, info.path, [&]() -> std::string {
    const support::ProcessResult help = support::runProcess(
        {compiler, "-march=native", "-Q", "--help=target"});  // GCC's way; others have no short name for it
    std::istringstream words(help.output);
    for (std::string word; help.ok() && words >> word;)
      if (word == "-march=" && words >> word) return word;
    return "native";
  });
  return info;
}

ToolInfo resolveGlslang(ToolMemory& memory) {
  const fs::path path = support::findProgram("glslangValidator");
  if (path.empty()) failUsage("no glslangValidator in PATH: the GLSL route needs it (Debian package glslang-tools)");
  return {path, memory.recall("version", path, [&] { return firstLine(run({path.string(), "--version"})); }), "PATH"};
}

std::string cpuDriverText() {
  ToolMemory memory(support::defaultCacheFolder());
  try {
    const CxxInfo cxx = resolveCxx(memory);
    return fmt::format("{}, {}", cxx.version, cxx.target);
  } catch (const Error&) {
    return "no C++ compiler";
  }
}

}  // namespace tessera::kernels
