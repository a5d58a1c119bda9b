#include "host/kernels/user-kernel.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/error.h>

#include <algorithm>
#include <map>
#include <ranges>
#include <regex>
#include <vector>

#include "host/axes/routes.h"
#include "host/kernels/slang-sources.h"
#include "host/support/file-faults.h"

namespace tessera::kernels {
namespace {

namespace fs = std::filesystem;

std::string describe(const std::string& stage, const fs::path& file) {
  return fmt::format("kernel {} ({})", stage, file.string());
}

/// Names of the functions that [numthreads(...)] stands on, in Slang or HLSL.
std::vector<std::string> entryPoints(const std::string& text) {
  static const std::regex comments(R"(//[^\n]*|/\*(?:[^*]|\*(?!/))*\*/)");
  static const std::regex entry(R"(\[\s*numthreads\s*\([^\]]*\](?:\s*\[[^\]]*\])*\s*void\s+(\w+)\s*\()");
  const std::string code = std::regex_replace(text, comments, " ");
  std::vector<std::string> names;
  for (std::sregex_iterator i(code.begin(), code.end(), entry), end; i != end; ++i) names.push_back((*i)[1]);
  return names;
}

std::string entryOf(const KernelRequest& own, const fs::path& file, const std::string& text) {
  const std::vector<std::string> names = entryPoints(text);
  if (std::ranges::count(names, own.entry) == 1) return own.entry;
  if (names.size() == 1) return names[0];
  failUsage(names.empty()
                ? fmt::format("{}: it has no compute entry point: [numthreads(...)] void {}(...) would be one",
                              describe(own.stage, file), own.entry)
                : fmt::format("{}: its entry points are {}: one alone, or one named `{}` as the stage's own, would do",
                              describe(own.stage, file), fmt::join(names, ", "), own.entry));
}

template <typename Map>
std::string namesOf(const Map& map) {
  return fmt::format("{}", fmt::join(std::views::keys(map), ", "));
}

std::string sizeText(const std::array<std::uint32_t, 3>& size) {
  return fmt::format("{} x {} x {}", size[0], size[1], size[2]);
}

void checkGroup(const CompiledKernel& users, const KernelInterface& own, const std::string& who) {
  const auto& size = users.interface.groupSize;
  if (size == own.groupSize) return;
  if (axes::routeInfo(users.route).oneThreadGroups)
    failUnsupported(
        fmt::format("{}: groups of {} threads; on the CPU device one thread is the group: take kThreadsPerGroup and "
                    "kLanesPerThread "
                    "of the module workgroup, or [numthreads(1, 1, 1)] and a loop where TESSERA_CPP is defined, or a "
                    "Vulkan device",
                    who, sizeText(size)));
  failUsage(fmt::format("{}: groups of {} threads; the stage's are {}", who, sizeText(size), sizeText(own.groupSize)));
}

}  // namespace

Language languageOf(const fs::path& file) {
  static const std::map<std::string, Language> languages{
      {".slang", Language::kSlang}, {".hlsl", Language::kHlsl}, {".comp", Language::kGlsl}, {".glsl", Language::kGlsl}};
  const auto found = languages.find(file.extension().string());
  if (found == languages.end())
    failUsage(fmt::format("{}: a kernel is .slang, .hlsl, .comp or .glsl (GLSL)", file.string()));
  return found->second;
}

Language languageOf(const KernelRequest& request) {
  return request.file.empty() ? Language::kSlang : languageOf(request.file);
}

KernelRequest requestOf(KernelRequest own, const fs::path& file) {
  if (const std::string why = support::whyNoFile(file); !why.empty())
    failUsage(fmt::format("{}: {}", describe(own.stage, file), why));
  const Language language = languageOf(file);
  if (language == Language::kGlsl && !axes::routeInfo(own.route).takesGlsl)
    failUnsupported(fmt::format(
        "{}: GLSL reaches Vulkan devices only; the CPU device takes .slang, or .hlsl with one thread a group",
        describe(own.stage, file)));
  for (const char* const generated : {"settings.slang", "variant.slang", "settings.glsl"})
    if (std::error_code error; fs::exists(file.parent_path() / generated, error))
      failUsage(fmt::format("{}: {} beside it would hide the generated one; another name would do",
                            describe(own.stage, file), generated));
  own.entry = language == Language::kGlsl ? "main" : entryOf(own, file, readText(file, ExitCode::kUsage));
  own.file = file;
  return own;
}

std::string glslSettings(const std::string& settings) {
  static const std::regex constant(R"(public static const (bool|int|uint|float) ([^;]*);)");
  std::string text = "// Generated: the settings of this stage.\n";
  for (std::sregex_iterator i(settings.begin(), settings.end(), constant), end; i != end; ++i)
    text += fmt::format("const {} {};\n", (*i)[1].str(), (*i)[2].str());
  return text;
}

void checkInterface(const CompiledKernel& users, const KernelInterface& own, const KernelInterface& all) {
  const std::string who = describe(users.stage, users.file);
  const KernelInterface& interface = users.interface;
  checkGroup(users, own, who);
  for (const auto& [name, size] : interface.elementSizes) {
    const auto there = all.elementSizes.find(name);
    if (there == all.elementSizes.end())
      failUsage(fmt::format("{}: no buffer is called `{}`; there are {}", who, name, namesOf(all.elementSizes)));
    if (size != there->second)
      failUsage(
          fmt::format("{}: an element of `{}` has {} bytes here, {} in the pipeline", who, name, size, there->second));
  }
  for (const std::string& name : own.writable)
    if (!interface.elementSizes.contains(name))
      failUsage(fmt::format("{}: it does not use `{}`, which the stage writes ({})", who, name,
                            fmt::join(own.writable, ", ")));
  for (const auto& [name, field] : interface.fields) {
    const auto there = all.fields.find(name);
    if (there == all.fields.end())
      failUsage(fmt::format("{}: `frame` has no field `{}`; there are {}", who, name, namesOf(all.fields)));
    if (field.size != there->second.size || field.floating != there->second.floating)
      failUsage(fmt::format("{}: `frame.{}` is a 32-bit {}", who, name, there->second.floating ? "float" : "integer"));
  }
}

std::string exactnessWarning(const CompiledKernel& users) {
  if (!axes::routeInfo(users.route).spirv) return "";
  const std::vector<std::string> violations = tessera::checkSpirv(users.binary);
  if (violations.empty()) return "";
  return fmt::format("{}: {} operation{} of its SPIR-V may round as the driver likes (parity tells), the first at {}",
                     describe(users.stage, users.file), violations.size(), violations.size() == 1 ? "" : "s",
                     violations[0]);
}

}  // namespace tessera::kernels
