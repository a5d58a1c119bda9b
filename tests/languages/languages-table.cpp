// Prints the table of host/languages.md: each stage written for each target, and what the target's judge says.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/error.h>
#include <tessera/input.h>
#include <tessera/plan.h>

#include <algorithm>
#include <fstream>
#include <future>
#include <regex>

#include "host/devices/vulkan/spirv-module.h"
#include "host/kernels/emit.h"
#include "host/kernels/spirv.h"
#include "host/plan/stages.h"
#include "host/support/files.h"
#include "host/support/subprocess.h"
#include "tests/support/streams.h"

namespace tessera::test {
namespace {

namespace fs = std::filesystem;

/// Kernels that together are every stage: a variant that brings some.
struct Kind {
  const char* settings;
  const char* label;
  bool clipSpace = false, attribute = false;
};
constexpr Kind kKinds[] = {{"clip=on shade=smooth", "`shade=smooth`, an attribute", false, true},
                           {"clip=on", "clip-space input", true},
                           {"commit=two-pass", "`commit=two-pass`"},
                           {"commit=depth24+lum8 shade=flat", "`commit=depth24+lum8`"},
                           {"commit=depth32+id32", "`commit=depth32+id32`"}};

Scene sceneOf(const Kind& kind) {
  Scene scene = loadInput("generate:icosphere?level=1");
  if (kind.attribute) attributeOf(scene).assign(scene.vertexCount(), 0.0f);
  if (kind.clipSpace) {
    scene.clip.assign(scene.vertexCount(), {0, 0, 0.5f, 2});
    scene.positions.clear();
    dropNormals(scene);
  }
  return scene;
}

/// What a program says about a file, its first line; "" where it ends well.
std::string judgedBy(std::vector<std::string> command, const std::string& bytes, const char* name) {
  const support::TemporaryFolder folder(fs::temp_directory_path(), "tessera-judge");
  const fs::path file = folder.path() / name;
  std::ofstream(file, std::ios::binary) << bytes;
  command.front() = support::findProgram(command.front()).string();
  command.push_back(file.string());
  const support::ProcessResult result = support::runProcess(command);
  return result.ok() ? "" : result.output.substr(0, result.output.find('\n'));
}

/// A module without OpSource, whose number for Slang Debian 12's spirv-val does not know.
std::string judgeSpirv(const fs::path& module) {
  const std::vector<std::uint32_t> words = devices::vulkan::readModule(module).words;
  return judgedBy({"spirv-val", "--target-env", "vulkan1.2"},
                  {reinterpret_cast<const char*>(words.data()), 4 * words.size()}, "module.spv");
}

/// What runs here is what was judged: C++ by the compiler of the CPU's kernels, GLSL by glslang, SPIR-V of both routes
/// by spirv-val.
std::string judge(KernelCache& cache, const KernelRequest& request, const kernels::EmitTarget& target,
                  const std::string& bytes) {
  if (target.name == "wgsl") return judgedBy({TESSERA_JUDGE_WGSL}, bytes, "kernel.wgsl");
  if (target.name != "cpp" && target.name != "glsl" && target.name != "spirv") return "";
  const CompiledKernel kernel = cache.get(request);
  return target.name == "cpp" ? "" : judgeSpirv(kernel.binary);
}

std::string withoutPlace(const std::string& complaint) {  // of this machine and this version of the file
  static const std::regex place(R"(^kernel .*: (?=error|ERROR))");
  return std::regex_replace(complaint, place, "");
}

/// And a note, if there is something to say.
struct Cell {
  std::string text, why;
};

class Table {
 public:
  std::string text() {
    std::string text = "| stage | brought by |";
    for (const kernels::EmitTarget& target : kernels::emitTargets()) text += fmt::format(" {} |", target.device.name);
    text += "\n|---|---|";
    for (std::size_t i = 0; i < kernels::emitTargets().size(); ++i) text += "---|";
    text += '\n';
    for (const Kind& kind : kKinds) text += rows(kind);
    for (std::size_t i = 0; i < notes_.size(); ++i) text += fmt::format("\n{}. {}\n", i + 1, notes_[i]);
    return text;
  }

 private:
  std::string rows(const Kind& kind) {
    const Scene scene = sceneOf(kind);
    const Plan all = makePlan(scene, Variant(kind.settings), kernels::emitTarget("spirv").device);
    std::string text;
    for (const std::string& stage : all.stages) {
      // 64-bit atomics are worth rows of their own.
      const bool wide =
          kind.settings == std::string("commit=depth32+id32") &&
          std::ranges::count(std::initializer_list<std::string>{"clear", "raster-items", "resolve"}, stage);
      if (std::ranges::count(seen_, stage) && !wide) continue;
      seen_.push_back(stage);
      text += fmt::format("| {} | {} |", stage, kind.label);
      std::vector<std::future<Cell>> cells;
      for (const kernels::EmitTarget& target : kernels::emitTargets())
        cells.push_back(std::async(std::launch::async, [&] { return cell(kind, scene, stage, target); }));
      for (auto& waiting : cells) {
        const Cell made = waiting.get();
        text += fmt::format(" {}{} |", made.text, made.why.empty() ? "" : note(made.why));
      }
      text += '\n';
    }
    return text;
  }

  Cell cell(const Kind& kind, const Scene& scene, const std::string& stage, const kernels::EmitTarget& target) {
    try {
      Variant variant(kind.settings);
      if (target.name == "glsl") variant.set("route", "glsl");
      const KernelRequest request = plan::kernelRequest(stage, makePlan(scene, variant, target.device));
      const kernels::Emitted emitted = kernels::emitKernel(cache_, request, target);
      if (!emitted.complaint.empty()) return {"no", withoutPlace(emitted.complaint)};
      const std::string said = judge(cache_, request, target, emitted.bytes);
      if (!said.empty()) return {"not valid", said};
      const bool judged = target.name != "hlsl" && target.name != "metal" && target.name != "cuda";
      return {judged ? "valid" : "written", ""};
    } catch (const Error& error) {
      return {"no", error.what()};
    }
  }

  std::string note(const std::string& text) {
    auto found = std::ranges::find(notes_, text);
    if (found == notes_.end()) found = notes_.insert(notes_.end(), text);
    return fmt::format(" ({})", found - notes_.begin() + 1);
  }

  KernelCache cache_;
  std::vector<std::string> seen_, notes_;
};

}  // namespace
}  // namespace tessera::test

int main() {
  try {
    fmt::print("{}", tessera::test::Table().text());
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
