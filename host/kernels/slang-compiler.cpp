#include "host/kernels/slang-compiler.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <regex>
#include <sstream>

#include "host/axes/routes.h"
#include "host/kernels/reflection.h"
#include "host/kernels/slang-sources.h"
#include "host/kernels/spirv-reflection.h"
#include "host/kernels/spirv.h"
#include "host/kernels/user-kernel.h"
#include "host/support/files.h"
#include "host/support/subprocess.h"

namespace tessera::kernels {
namespace {

namespace fs = std::filesystem;

/// Slang's prelude asks these macros at every index into a buffer or an array, in a member function of it (`data` is
/// the buffer's). Throwing crosses the entry point to the dispatch, with three numbers: index, count, address of the
/// buffer.
constexpr const char* kBoundsChecks = R"(#include <stdexcept>
#include <string>
[[noreturn]] static void tesseraOutOfBounds(size_t index, size_t count, const void* data)
{
    throw std::out_of_range(std::to_string((long long)index) + " " + std::to_string(count) + " " + std::to_string((size_t)data));
}
#define SLANG_BOUND_CHECK(index, count) if (!(index < count)) tesseraOutOfBounds(index, count, data);
#define SLANG_BOUND_CHECK_FIXED_ARRAY(index, count) if (!(index < count)) tesseraOutOfBounds(index, count, nullptr);
#define SLANG_BOUND_CHECK_BYTE_ADDRESS(index, elementSize, bytes) \
    if (!(index + elementSize <= bytes && index % 4 == 0)) tesseraOutOfBounds(index, bytes, data);
)";

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t|^~'`-");
  return first == std::string::npos ? "" : text.substr(first);
}

/// The first error in a compiler's output that has a place, or the first one, as one line. slangc writes
/// "error[E30015]: title", then " --> file:line:column", then the source with "^^^ message" under it; the others, and
/// older slangcs, write all on one line.
std::string firstError(const std::string& output) {
  std::istringstream lines(output);
  std::string line, title, place, first;
  while (std::getline(lines, line)) {
    const bool isTitle = line.rfind("error[", 0) == 0 || line.rfind("fatal error[", 0) == 0;
    const bool isError = isTitle || line.find("error") != std::string::npos || line.find("ERROR") != std::string::npos;
    if (first.empty() && isError) first = line;
    if (isError && !isTitle && title.empty()) return first;
    if (isTitle && place.empty()) title = line;
    if (const std::size_t arrow = line.find(" --> "); arrow != std::string::npos && !title.empty() && place.empty())
      place = line.substr(arrow + 5);
    if (const std::size_t caret = line.find('^'); caret != std::string::npos && !place.empty()) {
      const std::string message = trimmed(line.substr(caret));
      return fmt::format("{}: {}", place,
                         message.empty() ? title : title.substr(0, title.find(':') + 1) + " " + message);
    }
  }
  if (first.empty()) return output.empty() ? "it says nothing" : output.substr(0, output.find('\n'));
  return place.empty() ? first : place + ": " + title;
}

std::string describe(const KernelRequest& request) {
  return fmt::format("kernel {} ({}){}", request.stage, request.file.empty() ? request.source : request.file.string(),
                     request.variantName.empty() ? "" : " [" + request.variantName + "]");
}

void runCompiler(const KernelRequest& request, const std::vector<std::string>& arguments, const fs::path& made) {
  const support::ProcessResult result = support::runProcess(arguments, made.parent_path());
  if (!result.ok() || !fs::exists(made))
    throw Error(request.file.empty() ? ExitCode::kFailure : ExitCode::kUsage,  // a user's kernel is input
                fmt::format("{}: {}: {}", describe(request), fs::path(arguments[0]).filename().string(),
                            firstError(result.output)));
}

void append(std::vector<std::string>& to, const std::vector<std::string>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

/// Throws if slangc read a file that the key knows nothing of. The list is a make rule: "output: file file", spaces
/// escaped.
void checkDependencies(const std::string& rule, const std::map<fs::path, std::string>& sources, const fs::path& work) {
  const auto check = [&](const std::string& file) {
    if (file.empty() || !fs::exists(file)) return;
    const fs::path path = fs::weakly_canonical(file);
    for (const auto& [known, text] : sources)
      if (fs::weakly_canonical(known) == path) return;
    if (path.parent_path() != fs::weakly_canonical(work))
      fail(fmt::format("{}: read by slangc, but no import names it", file));
  };
  std::string file;
  const std::size_t colon = rule.find(": ");
  for (std::size_t i = colon == std::string::npos ? rule.size() : colon + 2; i < rule.size(); ++i) {
    if (rule[i] == '\\' && i + 1 < rule.size() && rule[i + 1] != '\n')
      file += rule[++i];
    else if (rule[i] == ' ' || rule[i] == '\n' || rule[i] == '\\')
      check(file), file.clear();
    else
      file += rule[i];
  }
  check(file);
}

/// slangc with the generated modules, which it finds in `work`.
std::vector<std::string> slangCommand(const KernelRequest& request, const ToolInfo& slangc,
                                      const fs::path& slangSources, const std::vector<std::string>& flags,
                                      const fs::path& work, const fs::path& made) {
  support::writeInto(work / "settings.slang", request.modules.settings);
  support::writeInto(work / "variant.slang", request.modules.variant);
  const fs::path source = request.file.empty() ? slangSources / request.source : request.file;
  std::vector<std::string> arguments{slangc.path.string(), source.string(), "-I", work.string()};
  for (const fs::path& folder : searchFolders(slangSources)) append(arguments, {"-I", folder.string()});
  append(arguments, flags);
  append(arguments, {"-entry", request.entry, "-stage", "compute", "-o", made.string()});
  return arguments;
}

/// Slang's C++ to a shared object.
void compileCpp(const KernelRequest& request, const CompileSettings& settings, const std::string& generated,
                const fs::path& work) {
  const fs::path source = work / "kernel.cpp", made = work / axes::routeInfo(request.route).binary;
  support::writeInto(source, (settings.boundsChecks ? kBoundsChecks : "") +
                                 machineText(settings.slangSources, usesLanes(generated), request.modules.laneWidth) +
                                 generated);
  std::vector<std::string> arguments{settings.cxx.path.string()};
  append(arguments, cxxBaseFlags());
  append(arguments, settings.cxxFlags);
  // The folder's name must not reach the binary (debug information has it): two that compile the same kernel make the
  // same bytes.
  append(arguments, {"-ffile-prefix-map=" + work.string() + "=.", "-o", made.string(), source.string()});
  runCompiler(request, arguments, made);
}

/// GLSL to a module, which comes back as words.
std::vector<std::uint32_t> compileGlsl(const KernelRequest& request, const CompileSettings& settings,
                                       const fs::path& source, const fs::path& work) {
  const fs::path made = work / axes::routeInfo(request.route).binary;
  runCompiler(request,
              {settings.glslang.path.string(), "-V", "--target-env", "vulkan1.2", "-S", "comp", "-I" + work.string(),
               "-o", made.string(), source.string()},
              made);
  return readSpirv(made);
}

/// A user's GLSL, as it is: what it does not call `precise` is the user's choice.
KernelInterface compileUsersGlsl(const KernelRequest& request, const CompileSettings& settings, const fs::path& work) {
  support::writeInto(work / "settings.glsl", glslSettings(request.modules.settings));
  return readSpirvInterface(compileGlsl(request, settings, request.file, work));
}

}  // namespace

const std::vector<std::string>& cxxBaseFlags() {
  static const std::vector<std::string> flags{"-std=c++17",
                                              "-O3",
                                              "-march=native",
                                              "-ffp-contract=off",
                                              "-fno-math-errno",
                                              "-fno-trapping-math",
                                              "-fno-semantic-interposition",
                                              "-fvisibility=hidden",
                                              "-shared",
                                              "-fPIC",
                                              "-w"};
  return flags;
}

std::string binaryEntry(const KernelRequest& request) {
  return axes::routeInfo(request.route).spirv ? "main" : request.entry;
}

namespace {

KernelInterface compileSlang(const KernelRequest& request, const CompileSettings& settings,
                             const std::map<fs::path, std::string>& sources, const fs::path& work) {
  const fs::path reflection = work / "reflection.json", dependencies = work / "dependencies";
  const axes::RouteInfo& route = axes::routeInfo(request.route);
  const fs::path made = work / route.written, binary = work / route.binary;
  std::vector<std::string> arguments =
      slangCommand(request, settings.slangc, settings.slangSources, route.slangFlags, work, made);
  append(arguments, {"-reflection-json", reflection.string(), "-depfile", dependencies.string()});
  runCompiler(request, arguments, made);

  if (fs::exists(dependencies)) checkDependencies(readText(dependencies), sources, work);
  const std::string generated = route.then == axes::SecondCompiler::kCxx ? readText(made) : "";
  if (route.then == axes::SecondCompiler::kCxx) compileCpp(request, settings, generated, work);
  if (route.then == axes::SecondCompiler::kGlslang) {
    std::vector<std::uint32_t> words = compileGlsl(request, settings, made, work);
    decorateNoContraction(words);
    writeSpirv(binary, words);
  }
  if (route.spirv && request.file.empty())
    if (const std::vector<std::string> violations = tessera::checkSpirv(binary); !violations.empty())
      fail(fmt::format("its SPIR-V is not exact: {}", violations[0]));
  return readReflection(readText(reflection), request.route, generated);
}

}  // namespace

KernelInterface compileKernel(const KernelRequest& request, const CompileSettings& settings,
                              const std::map<fs::path, std::string>& sources, const fs::path& work) {
  try {
    return languageOf(request) == Language::kGlsl ? compileUsersGlsl(request, settings, work)
                                                  : compileSlang(request, settings, sources, work);
  } catch (const support::WriteError&) {
    throw;
  } catch (const Error& error) {
    const std::string what = error.what(), name = describe(request);
    support::checkWritten(work, what);
    const ExitCode code = request.file.empty() ? error.code() : ExitCode::kUsage;
    throw Error(code, what.rfind(name, 0) == 0 ? what : name + ": " + what);
  }
}

Written writtenBySlang(const KernelRequest& request, const std::string& target, const ToolInfo& slangc,
                       const fs::path& slangSources) {
  const support::TemporaryFolder work(support::temporaryRoot(), "tessera-emit");
  const fs::path made = work.path() / "made", reflection = work.path() / "reflection.json";
  const axes::RouteInfo& route = axes::routeInfo(request.route);
  std::vector<std::string> flags{"-target", target, "-fp-mode", "precise", "-line-directive-mode", "none"};
  if (target == route.name) flags = route.slangFlags;
  if (target == "wgsl") flags.push_back("-DTESSERA_WGSL");  // slang/machine/atomics.slang
  // Buffers are called as in Slang; in C++ and CUDA they are members, which keep their numbers.
  for (const char* const unmangled : {"wgsl", "glsl", "hlsl", "metal"})
    if (target == unmangled) flags.push_back("-no-mangle");
  flags.insert(flags.end(), {"-reflection-json", reflection.string()});
  try {
    runCompiler(request, slangCommand(request, slangc, slangSources, flags, work.path(), made), made);
    const bool cxx = route.then == axes::SecondCompiler::kCxx;
    std::string text = readText(made);
    if (cxx) text = machineText(slangSources, usesLanes(text), request.modules.laneWidth) + text;
    // WGSL reserves this word (W3C, WebGPU Shading Language, section 16.2).
    if (target == "wgsl") text = std::regex_replace(text, std::regex(R"(\battribute\b)"), "attribute_0");
    return {std::move(text), readText(reflection)};
  } catch (const support::WriteError&) {
    throw;
  } catch (const Error& error) {
    support::checkWritten(work.path(), error.what());
    throw;
  }
}

}  // namespace tessera::kernels
