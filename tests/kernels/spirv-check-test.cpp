// The static check of SPIR-V finds what is planted, each kind by name, and nothing in a module that keeps the contract.
#include <algorithm>
#include <catch2/catch.hpp>

#include "fixture.h"
#include "host/kernels/spirv.h"
#include "host/support/subprocess.h"

namespace tessera::test {
namespace fs = std::filesystem;

namespace {

std::vector<std::uint32_t> compile(const std::string& expression,
                                   const std::vector<std::string>& more = {"-fp-mode", "precise"}) {
  const Workshop shop;
  const fs::path source = shop.folder.path() / "planted.slang", module = shop.folder.path() / "planted.spv";
  writeText(
      source,
      "RWStructuredBuffer<float> a;\n[shader(\"compute\")] [numthreads(1,1,1)]\nvoid go(uint3 g : SV_GroupID)\n{\n"
      "    const float x = a[g.x], y = a[g.x + 1], z = a[g.x + 2];\n    const float3 u = float3(x, y, z), v = "
      "float3(z, x, y);\n"
      "    a[g.x + 3] = " +
          expression + ";\n}\n");
  static const std::string slangc = shop.open().slangc().path.string();
  std::vector<std::string> arguments{slangc, source.string(), "-target", "spirv", "-O1",          "-entry",
                                     "go",   "-stage",        "compute", "-o",    module.string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const support::ProcessResult result = support::runProcess(arguments);
  INFO(result.output);
  REQUIRE(result.ok());
  return kernels::readSpirv(module);
}

}  // namespace

TEST_CASE("An exact module has no violations") {
  CHECK(kernels::checkSpirv(compile("x * y + z / x - sqrt(abs(floor(y)))")).empty());
  CHECK(kernels::checkSpirv(compile("(u * v).x + (u * x).y + (u / v).z - float(int(x) < 3 ? min(int(y), 2) : 1)"))
            .empty());
}

TEST_CASE("Planted violations are found by name") {
  const std::vector<std::pair<std::string, std::string>> planted = {
      {"dot(u, v)", "OpDot"}, {"lerp(x, y, z)", "FMix"},       {"fma(x, y, z)", "Fma"},
      {"round(x)", "Round"},  {"fmod(x, y)", "OpFRem"},        {"min(x, y)", "FMin"},
      {"max(x, y)", "FMax"},  {"clamp(x, y, z)", "FClamp"},    {"rsqrt(x)", "InverseSqrt"},
      {"pow(x, y)", "Pow"},   {"normalize(u).x", "Normalize"}, {"mul(float3x3(u, v, u), v).x", "Matrix"}};
  std::string statements = "0";
  for (std::size_t i = 0; i < planted.size(); ++i)
    statements += ";\n    a[g.x + " + std::to_string(i + 4) + "] = " + planted[i].first;
  const std::vector<std::string> violations = kernels::checkSpirv(compile(statements));
  CHECK(violations.size() >= planted.size());
  for (const auto& [expression, name] : planted) {
    INFO(expression);
    CHECK(std::any_of(violations.begin(), violations.end(),
                      [&](const std::string& line) { return line.find(name) != std::string::npos; }));
  }
}

TEST_CASE("Each operation without NoContraction is found") {
  for (const auto& [expression, name] :
       {std::pair{"x + y", "OpFAdd"}, {"x - y", "OpFSub"}, {"x * y", "OpFMul"}, {"x / y", "OpFDiv"}}) {
    const std::vector<std::string> violations = kernels::checkSpirv(compile(expression, {"-fp-mode", "fast"}));
    REQUIRE(violations.size() == 1);
    CHECK(contains(violations[0], std::string(name) + " without NoContraction"));
  }
  const std::vector<std::string> vector = kernels::checkSpirv(compile("(u * x).y + (u * x).z", {"-fp-mode", "fast"}));
  CHECK(vector.size() == 2);
  CHECK(contains(vector.at(0), "OpVectorTimesScalar without NoContraction"));
}

TEST_CASE("Decorating a module changes its annotations and nothing else") {
  std::vector<std::uint32_t> fast = compile("x * y + z / x - u.y * v.z", {"-fp-mode", "fast"});
  const std::vector<std::uint32_t> before = fast;
  const std::size_t missing = kernels::checkSpirv(fast).size();
  REQUIRE(missing == 5);
  kernels::decorateNoContraction(fast);
  CHECK(kernels::checkSpirv(fast).empty());
  REQUIRE(fast.size() == before.size() + 3 * missing);
  const auto differ = std::mismatch(before.begin(), before.end(), fast.begin());
  CHECK(std::equal(differ.first, before.end(), differ.second + static_cast<std::ptrdiff_t>(3 * missing)));
  const std::vector<std::uint32_t> once = fast;
  kernels::decorateNoContraction(fast);
  CHECK(fast == once);
}

TEST_CASE("The GLSL route is exact only by that repair") {
  const Workshop shop;
  const fs::path text = shop.folder.path() / "a.comp", module = shop.folder.path() / "a.spv";
  writeText(text,
            "#version 450\nlayout(std430, binding = 0) buffer B { float a[]; };\nvoid main() { a[0] = a[1] * a[2] + "
            "a[3]; }\n");
  REQUIRE(support::runProcess({support::findProgram("glslangValidator").string(), "-V", "-S", "comp", "-o",
                               module.string(), text.string()})
              .ok());
  CHECK(checkSpirv(module).size() == 2);
  CHECK(checkSpirv(shop.open().get(scaleRequest(Route::kGlsl)).binary).empty());
}

TEST_CASE("What is no SPIR-V module is refused") {
  const Workshop shop;
  writeText(shop.folder.path() / "a.spv", "certainly not a module, whatever its length");
  CHECK(contains(lineOf(ExitCode::kFailure, [&] { checkSpirv(shop.folder.path() / "a.spv"); }), "not a SPIR-V module"));
  CHECK(contains(lineOf(ExitCode::kFailure, [&] { checkSpirv(shop.folder.path() / "none.spv"); }), "none.spv"));
  std::vector<std::uint32_t> words = compile("x + y");
  words.push_back(9u << 16 | 1);  // an instruction of nine words, of which there is one
  CHECK(contains(lineOf(ExitCode::kFailure, [&] { kernels::checkSpirv(words); }), "does not fit"));
}

}  // namespace tessera::test
