// How fast mesh files are read: bytes a second of each format, from the page cache to a Mesh, normals apart. The bars
// are 200 MB/s for text and 1 GB/s for binary files; the label says whether a format is over its bar here.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <tessera/input.h>

#include <algorithm>
#include <bit>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "datasets/mesh-formats.h"
#include "datasets/normals.h"
#include "datasets/text.h"
#include "host/support/files.h"

namespace tessera::bench {
namespace {

constexpr double kTextBar = 200e6, kBinaryBar = 1e9;

template <class T>
void put(std::string& out, T value, bool big = false) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (big) std::ranges::reverse(bytes);
  out.append(bytes.data(), bytes.size());
}

const Mesh& mesh() {
  static const Mesh sphere = generateMesh("icosphere?level=8");
  return sphere;
}

std::string objOf(bool normals) {
  std::string text;
  auto out = std::back_inserter(text);
  for (const glm::dvec3& p : mesh().positions) fmt::format_to(out, "v {:.6f} {:.6f} {:.6f}\n", p.x, p.y, p.z);
  if (normals)
    for (const glm::vec3& n : mesh().normals) fmt::format_to(out, "vn {:.4f} {:.4f} {:.4f}\n", n.x, n.y, n.z);
  for (const auto& [a, b, c] : mesh().triangles)
    if (normals)
      fmt::format_to(out, "f {0}//{0} {1}//{1} {2}//{2}\n", a + 1, b + 1, c + 1);
    else
      fmt::format_to(out, "f {} {} {}\n", a + 1, b + 1, c + 1);
  return text;
}

std::string offOf() {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh().positions.size(), mesh().triangles.size());
  auto out = std::back_inserter(text);
  for (const glm::dvec3& p : mesh().positions) fmt::format_to(out, "{:.17g} {:.17g} {:.17g}\n", p.x, p.y, p.z);
  for (const auto& [a, b, c] : mesh().triangles) fmt::format_to(out, "3 {} {} {}\n", a, b, c);
  return text;
}

std::string plyOf(const std::string& format) {
  std::string text = fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\nelement face {}\n"
      "property list uchar int vertex_indices\nend_header\n",
      format, mesh().positions.size(), mesh().triangles.size());
  const bool ascii = format == "ascii", big = format == "binary_big_endian";
  for (const glm::vec3 p : std::vector<glm::vec3>(mesh().positions.begin(), mesh().positions.end())) {
    if (ascii) fmt::format_to(std::back_inserter(text), "{} {} {}\n", p.x, p.y, p.z);
    for (int axis = 0; axis < 3 && !ascii; ++axis) put(text, p[axis], big);
  }
  for (const auto& [a, b, c] : mesh().triangles) {
    if (ascii) fmt::format_to(std::back_inserter(text), "3 {} {} {}\n", a, b, c);
    if (!ascii) text.push_back(3);
    for (const std::uint32_t v : {a, b, c})
      if (!ascii) put(text, v, big);
  }
  return text;
}

std::string stlOf(bool ascii) {
  std::string text = ascii ? "solid a\n" : std::string(80, '\0');
  if (!ascii) put(text, static_cast<std::uint32_t>(mesh().triangles.size()));
  for (const Triangle& t : mesh().triangles) {
    if (ascii) text += "facet normal 0 0 0\n  outer loop\n";
    if (!ascii) text.append(12, '\0');
    for (const std::uint32_t v : t) {
      const glm::vec3 p(mesh().positions[v]);
      if (ascii) fmt::format_to(std::back_inserter(text), "    vertex {} {} {}\n", p.x, p.y, p.z);
      for (int axis = 0; axis < 3 && !ascii; ++axis) put(text, p[axis]);
    }
    if (ascii) text += "  endloop\nendfacet\n";
    if (!ascii) text.append(2, '\0');
  }
  return ascii ? text + "endsolid a\n" : text;
}

struct Case {
  std::string name, file;
  std::string (*make)();
  bool binary;
};
const std::vector<Case> kCases{
    {"obj", "a.obj", [] { return objOf(false); }, false},
    {"obj-with-normals", "a.obj", [] { return objOf(true); }, false},
    {"off", "a.off", [] { return offOf(); }, false},
    {"ply-text", "a.ply", [] { return plyOf("ascii"); }, false},
    {"stl-text", "a.stl", [] { return stlOf(true); }, false},
    {"ply-little-endian", "a.ply", [] { return plyOf("binary_little_endian"); }, true},
    {"ply-big-endian", "a.ply", [] { return plyOf("binary_big_endian"); }, true},
    {"stl-binary", "a.stl", [] { return stlOf(false); }, true},
};

/// Reading has one thread, and its own time says the same on a busy machine.
double threadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Both the file, from the page cache, and its parsing: what a command waits for.
void read(benchmark::State& state, const Case& one, const std::string& path) {
  std::ofstream(path, std::ios::binary) << one.make();
  const auto size = static_cast<double>(std::filesystem::file_size(path));
  double seconds = 0;
  for (auto _ : state) {
    const double begin = threadSeconds();
    {
      Mesh read = datasets::readMeshAsItIs(path, {}, {});
      benchmark::DoNotOptimize(read.triangles.data());
    }
    const double took = threadSeconds() - begin;
    state.SetIterationTime(took);
    seconds += took;
  }
  std::filesystem::remove(path);
  state.SetBytesProcessed(static_cast<std::int64_t>(size) * state.iterations());
  const double rate = size * static_cast<double>(state.iterations()) / seconds,
               bar = one.binary ? kBinaryBar : kTextBar;
  state.SetLabel(fmt::format("{:.0f} MB, {} times its bar of {:.0f} MB/s", size / 1e6,
                             fmt::format("{:.2f}", rate / bar), bar / 1e6));
}

void normals(benchmark::State& state) {
  for (auto _ : state) {
    state.PauseTiming();
    Mesh copy = mesh();
    copy.normals.clear();
    state.ResumeTiming();
    datasets::completeNormals(copy);
  }
  state.SetLabel("completeNormals(), which follows where a file has none");
}

}  // namespace
}  // namespace tessera::bench

int main(int argc, char** argv) {
  const tessera::support::TemporaryFolder folder(std::filesystem::temp_directory_path(), "bench-reading");
  for (const tessera::bench::Case& one : tessera::bench::kCases)
    benchmark::RegisterBenchmark(
        ("read:" + one.name).c_str(),
        [&](benchmark::State& state) { tessera::bench::read(state, one, (folder.path() / one.file).string()); })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("normals", tessera::bench::normals)->Unit(benchmark::kMillisecond);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
