// What the host cannot bind, or a compiler cannot read, is named in one line.
#include <catch2/catch.hpp>

#include "fixture.h"
#include "host/kernels/user-kernel.h"

using namespace tessera;
using namespace tessera::test;

namespace {

std::string complaintOf(const std::string& stage, const std::filesystem::path& file, ExitCode code = ExitCode::kUsage,
                        const std::string& route = "spirv") {
  return lineOf(code, [&] {
    Machine machine = machineWith(route, {{stage, file}});
    machine.render(smallScene(), {{"shade", "id"}});
  });
}

struct Mistake {
  Bench::Edits edits;              ///< of an example that is right
  std::vector<std::string> named;  ///< parts of the line
};

void check(const std::string& stage, const std::string& name, const std::vector<Mistake>& mistakes) {
  const Bench bench;
  for (const Mistake& mistake : mistakes) {
    const std::string line = complaintOf(stage, bench.edited(name, mistake.edits));
    CHECK(contains(line, "kernel " + stage + " ("));
    CHECK(contains(line, name));
    for (const std::string& part : mistake.named) CHECK(contains(line, part));
  }
}

}  // namespace

TEST_CASE("Buffers and uniforms of GLSL that do not fit are named") {
  const std::string more = "bool isFinite(float a)";  // ahead of which something is declared
  check(
      "transform", "transform.comp",
      {{{{"{ float positions[]; }", "{ float positions[]; } places"},
         {"positions[3 * v], y = positions[3 * v + 1], z = positions[3 * v + 2]",
          "places.positions[v], y = places.positions[v], z = places.positions[v]"}},
        {"no buffer is called `places`", "positions", "corners"}},
       {{{"vec4 clipSpace[]", "vec2 clipSpace[]"}, {"clipSpace[v] = c;", "clipSpace[v] = c.xy;"}},
        {"an element of `clipSpace` has 8 bytes", "16"}},
       {{{"layout(std430, binding = 2) writeonly buffer ClipSpace { vec4 clipSpace[]; };", ""},
         {"clipSpace[v] = c;", ""}},
        {"does not use `clipSpace`"}},
       {{{"guardX, guardY;", "guardX, guardY, ratio;"}}, {"no field `ratio`", "halfWidth", "vertexCount"}},
       {{{"float m00, m01", "mat4 all; float m00, m01"}}, {"no field `all`"}},
       {{{"float m00, m01", "uint m00; float m01"}}, {"`frame.m00` is a 32-bit float"}},
       {{{"local_size_x = 64", "local_size_x = 32"}}, {"32 x 1 x 1", "64 x 1 x 1"}},
       {{{"binding = 3", "binding = 2"}}, {"`clipSpace` and `corners` have binding 2 both"}},
       {{{"binding = 3", "set = 1, binding = 3"}}, {"`corners` is in descriptor set 1"}},
       {{{more, "layout(binding = 9) uniform sampler2D picture;\n" + more}}, {"`picture` is neither"}},
       {{{more, "layout(binding = 9) uniform More { float a; } more;\n" + more}}, {"uniform block `more`", "`frame`"}},
       {{{"{ float positions[]; }", "{ float one; float positions[]; }"}}, {"storage block", "one array"}}});
}

TEST_CASE("Buffers and uniforms of Slang and HLSL that do not fit are named") {
  check("shade", "by-depth.slang",
        {{{{"uint> depth", "uint> depths"}, {"asfloat(depth[", "asfloat(depths["}},
          {"no buffer is called `depths`", "depth", "colour"}},
         {{{"uint> depth", "uint2> depth"}, {"asfloat(depth[pixel])", "asfloat(depth[pixel].x)"}},
          {"an element of `depth` has 8 bytes", "4"}},
         {{{"colour[3 * pixel + channel] = ", "const float unused = "}}, {"does not use `colour`"}}});
  check("shade", "by-row.hlsl",
        {{{{"{ uint width,", "{ uint breadth,"},
           {"frame.width)", "frame.breadth)"},
           {"frame.width)", "frame.breadth)"},
           {"frame.width)", "frame.breadth)"},
           {"frame.width)", "frame.breadth)"}},
          {"no field `breadth`", "width"}},
         {{{"{ uint width,", "{ float width; uint"}}, {"`frame.width` is a 32-bit integer"}},
         {{{"numthreads(64, 1, 1)", "numthreads(8, 8, 1)"}}, {"8 x 8 x 1", "64 x 1 x 1"}}});
}

TEST_CASE("What a compiler cannot read is named with its line") {
  check("transform", "transform.comp", {{{{"precise vec4 c;", "precise vec5 c;"}}, {"transform.comp:85"}}});
  check("shade", "by-depth.slang", {{{{"asfloat(depth", "asfloat(dpeth"}}, {"by-depth.slang:", "dpeth"}}});
  check("shade", "by-row.hlsl", {{{{"ids[pixel]", "idz[pixel]"}}, {"by-row.hlsl:", "idz"}}});
}

TEST_CASE("The entry point is the only one or the one that the stage's own has") {
  const std::string second = "[numthreads(64, 1, 1)] void second(uint3 g : SV_GroupID) { colour[g.x] = 1; }\n";
  const std::string entry = "[numthreads(64, 1, 1)]\nvoid paint(";
  check("shade", "by-row.hlsl",
        {{{{entry, second + entry}}, {"second, paint", "`shade`"}},
         {{{entry, "void paint("}}, {"no compute entry point"}}});
  const Bench bench;
  const auto named =
      bench.edited("by-row.hlsl", {{entry, second + "// void third(\n[numthreads(64, 1, 1)] void shade("}});
  Machine machine = machineWith("spirv", {{"shade", named}});
  CHECK(machine.render(smallScene(), {{"shade", "id"}}).image.colour[0] == glm::vec3(0, 0, 1));
}

TEST_CASE("Files that are not kernels and stages that do not run are refused") {
  const Bench bench;
  CHECK(contains(complaintOf("shade", bench.folder.path() / "none.slang"), "no such file"));
  CHECK(contains(complaintOf("shade", bench.write("shade.metal", "")), ".slang, .hlsl, .comp or .glsl"));
  for (const char* const name : {"settings.slang", "variant.slang", "settings.glsl"}) {
    const Bench shadowed;
    shadowed.write(name, "");
    CHECK(contains(complaintOf("shade", shadowed.edited("by-row.hlsl", {})), std::string(name) + " beside it"));
  }
  const std::string line = complaintOf("project", example("transform.comp"));
  CHECK(contains(line, "does not run"));
  CHECK(contains(line, "transform, setup"));
}

TEST_CASE("The CPU refuses what it cannot run and says what it could") {
  const std::string glsl = complaintOf("transform", example("transform.comp"), ExitCode::kUnsupported, "cpp");
  CHECK(contains(glsl, "GLSL reaches Vulkan devices only"));
  const std::string hlsl = complaintOf("shade", example("by-row.hlsl"), ExitCode::kUnsupported, "cpp");
  CHECK(contains(hlsl, "one thread is the group"));
  CHECK(contains(hlsl, "kThreadsPerGroup"));
}
