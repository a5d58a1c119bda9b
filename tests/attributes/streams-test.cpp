// Named streams: of one to four floats, several at once, owned or borrowed, read in place and within their bounds.
#include "tests/support/streams.h"

#include <sys/mman.h>
#include <tessera/device-kind.h>
#include <tessera/error.h>
#include <tessera/image.h>
#include <tessera/input.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <deque>
#include <fstream>

#include "datasets/random.h"
#include "host/support/files.h"
#include "tests/support/compare.h"
#include "tests/support/cut-device.h"
#include "tests/support/machines.h"
#include "tests/support/random-scene.h"
#include "tests/support/variants.h"

using namespace tessera;
using namespace tessera::test;

namespace {

void addStreams(Scene& scene, std::uint64_t seed) {
  datasets::Random random(seed);
  for (const unsigned components : {3u, 1u, 4u, 2u}) {
    Stream& stream = scene.makeStream("of " + std::to_string(components), components, true);
    for (std::size_t i = 0; i < components * scene.vertexCount(); ++i)
      stream.values.push_back(static_cast<float>(random.between(-9, 9)));
  }
}

/// Memory of a program: it ends where the next page cannot be read, and nothing may write it.
class Guarded {
 public:
  template <typename T>
  Array<T> copy(const Array<T>& values) {
    const std::size_t page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE)), bytes = values.size() * sizeof(T);
    const std::size_t room = (bytes + page - 1) / page * page;
    void* const at = mmap(nullptr, room + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    REQUIRE(at != MAP_FAILED);
    maps_.push_back({at, room + page});
    auto* const first = static_cast<std::byte*>(at) + room - bytes;
    std::memcpy(first, values.data(), bytes);
    REQUIRE(mprotect(at, room + page, PROT_NONE) == 0);
    if (room > 0) REQUIRE(mprotect(at, room, PROT_READ) == 0);
    return Array<T>::borrow(reinterpret_cast<const T*>(first), values.size());
  }
  ~Guarded() {
    for (const auto& [at, bytes] : maps_) munmap(at, bytes);
  }

 private:
  std::deque<std::pair<void*, std::size_t>> maps_;
};

Scene borrowed(const Scene& scene, Guarded& memory) {
  Scene copy = scene;
  copy.positions = memory.copy(scene.positions);
  copy.clip = memory.copy(scene.clip);
  copy.triangles = memory.copy(scene.triangles);
  for (std::size_t i = 0; i < scene.streams.size(); ++i) copy.streams[i].values = memory.copy(scene.streams[i].values);
  return copy;
}

}  // namespace

PLACE_TEST_CASE("Streams of one to four floats have the oracle's bits, whole and cut", "[attributes]") {
  for (std::uint64_t seed = 300; seed < 312; ++seed) {
    Scene scene = randomScene(seed);
    addStreams(scene, seed);
    const Frame frame = machine.render(scene);
    INFO(scene.name);
    CHECK(difference(frame, oracle::render(scene)) == "");
    REQUIRE(frame.image.channels.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) {
      CHECK(frame.image.channels[i].name == scene.streams[i].name);
      CHECK(frame.image.channels[i].floats().size() == frame.image.pixels() * scene.streams[i].components);
    }
  }
  Scene scene = loadInput("generate:icosphere?level=5", 300, 200);
  addStreams(scene, 5);
  auto cut = makeCutDevice(openDevice(machine.info().api), 400 << 10);
  Rasterizer rasterizer(*cut, machine.kernels());
  const Frame frame = rasterizer.render(scene);
  CHECK(frame.counters.at("batches") > 1);
  CHECK(frame.counters.at("bands") > 1);
  CHECK(difference(frame, oracle::render(scene)) == "");
}

CHECKED_PLACE_TEST_CASE("Borrowed arrays are read in place, within their bounds, with the bits of owned ones",
                        "[attributes]") {
  std::vector<Scene> scenes{loadInput("generate:icosphere?level=3", 160, 120)};
  for (std::uint64_t seed = 400; scenes.size() < 16; ++seed) scenes.push_back(randomScene(seed));
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    Scene& scene = scenes[i];
    addStreams(scene, i);
    const bool smooth = scene.stream(kNormals) != nullptr;
    const Variant variants[] = {smooth ? Variant{{"shade", "smooth"}} : Variant{{"shade", "id"}},
                                {{"binning", "none"}, {"clip", "on"}}};
    Guarded memory;
    const Scene in = borrowed(scene, memory);
    REQUIRE(sceneHash(in) == sceneHash(scene));
    for (const Variant& variant : variants) {
      INFO(scene.name << ", " << variant.text());
      const Frame lent = machine.render(in, variant), owned = machine.render(scene, variant);
      CHECK(difference(lent.image, owned.image) == "");
      CHECK(lent.image.colour == owned.image.colour);
      CHECK(lent.counters == owned.counters);
    }
  }
}

PLACE_TEST_CASE("Nothing of a borrowed array is kept when render returns", "[attributes]") {
  const Scene first = loadInput("generate:soup?count=300&pixels=200&seed=1", 80, 80),
              second = loadInput("generate:soup?count=300&pixels=200&seed=2", 80, 80);
  std::vector<glm::vec4> clip(oracle::transform(first));
  Scene scene;
  scene.width = scene.height = 80;
  scene.triangles = first.triangles;
  scene.clip = Array<glm::vec4>::borrow(clip);
  const Frame before = machine.render(scene);
  std::ranges::copy(oracle::transform(second), clip.begin());  // at the same address
  scene.triangles = second.triangles;
  const Frame after = machine.render(scene);
  CHECK(difference(after, oracle::render(scene)) == "");
  CHECK(difference(after.image, before.image) != "");
}

PLACE_TEST_CASE("Streams of ever new names take no more memory than those of one frame", "[attributes]") {
  const auto device = openDevice(machine.info().api);
  Rasterizer rasterizer(*device, machine.kernels());
  Scene scene = loadInput("generate:icosphere?level=4", 320, 240);
  const auto render = [&](const std::string& name, float value) {
    scene.streams.clear();
    scene.makeStream(name, 4, true).values.own().assign(4 * scene.vertexCount(), value);
    scene.makeStream(name + " too", 2, true).values.own().assign(2 * scene.vertexCount(), -value);
    const Frame frame = rasterizer.render(scene);
    INFO(name);
    REQUIRE(frame.image.channels.size() == 2);
    std::size_t covered = 0, right = 0;
    for (std::size_t k = 0; k < frame.image.pixels(); ++k) {
      if (frame.image.ids[k] == kNoTriangle) continue;
      ++covered;
      right += std::abs(frame.image.channels[0].floats()[4 * k + 3] - value) < 1e-3f &&
               std::abs(frame.image.channels[1].floats()[2 * k] + value) < 1e-3f;
    }
    CHECK(covered > 1000);
    CHECK(right == covered);
  };
  render("first", 1);
  const std::uint64_t once = device->peakBufferBytes();
  CHECK(once > 6 * sizeof(float) * scene.width * scene.height);
  for (int k = 0; k < 50; ++k) render("stream " + std::to_string(k), static_cast<float>(k + 2));
  render("first", 7);  // a name that comes again
  CHECK(device->peakBufferBytes() == once);
  // Neither a scene without streams nor one that has its streams still is misled by the names before.
  scene.streams.clear();
  CHECK(rasterizer.render(scene).image.channels.empty());
  render("first", 8);
  render("first", 9);
  CHECK(device->peakBufferBytes() == once);
}

TEST_CASE("A frame that fails gives borrowed memory back", "[attributes]") {
  const Machine& machine = *machineAt<Cpu>();
  Scene scene = loadInput("generate:soup?count=3000&pixels=900", 200, 200);
  const std::uint64_t peak = [&] {
    auto device = openDevice("cpu");
    Rasterizer rasterizer(*device, const_cast<Machine&>(machine).kernels());
    CHECK_THROWS_AS(rasterizer.render(scene, Variant("capacity=16 overflow=error")), Error);
    scene.triangles = {};  // the memory is gone
    rasterizer.render(scene);
    return device->peakBufferBytes();
  }();
  CHECK(peak > 0);
}

TEST_CASE("A stream that does not fit its scene is refused by name", "[attributes]") {
  const Machine& machine = *machineAt<Cpu>();
  Scene scene = loadInput("generate:icosphere?level=1", 64, 64);
  const auto message = [&](const Scene& asked) {
    try {
      machine.plan(asked);
    } catch (const Error& error) {
      CHECK(error.code() == ExitCode::kUsage);
      return std::string(error.what());
    }
    return std::string();
  };
  Stream& heat = scene.makeStream("heat", 2, true);
  heat.values.assign(7, 0);
  CHECK(message(scene) == "attribute heat: 7 values for 42 vertices; 84 would be right");
  heat.components = 5;
  CHECK(message(scene) == "attribute heat: 5 floats a vertex; 1 to 4 would be right");
  heat.components = 1;
  heat.values.assign(42, 0);
  CHECK(message(scene) == "");
  Stream& tint = scene.makeStream("tint", 3, false);  // a kernel of a user may read it
  tint.values.assign(42, 0);
  CHECK(message(scene) == "stream tint: 42 values for 42 vertices; 126 would be right");
  scene.streams.pop_back();
  scene.streams.push_back(scene.streams.back());
  CHECK(message(scene) == "attribute heat: two streams have this name");
}

TEST_CASE("Channels of several streams come back from a file", "[attributes]") {
  const support::TemporaryFolder folder(support::temporaryRoot(), "tessera-test");
  Scene scene = loadInput("generate:icosphere?level=2", 50, 40);
  addStreams(scene, 1);
  scene.makeStream("dotted.x", 1, true).values.assign(scene.vertexCount(), 2);
  const Framebuffer made = oracle::render(scene).image;
  Framebuffer frame = made;
  frame.hits.clear();
  const auto path = folder.path() / "streams.exr";
  writeImage(path, frame);
  const Framebuffer back = readImage(path);
  REQUIRE(back.channels.size() == 5);
  for (const Channel& channel : frame.channels) {
    INFO(channel.name);
    REQUIRE(back.channel(channel.name) != nullptr);
    CHECK(back.channel(channel.name)->components == channel.components);
    CHECK(std::memcmp(back.channel(channel.name)->floats().data(), channel.floats().data(),
                      4 * channel.floats().size()) == 0);
  }
  CHECK(compare(frame, back).equal());
  Framebuffer other = back;
  other.channels.back().floats()[0] = 7;
  CHECK(compare(frame, other).attribute == 1);
}

PLACE_TEST_CASE("A kernel binds a stream by its name", "[attributes]") {
  const support::TemporaryFolder folder(support::temporaryRoot(), "tessera-test");
  const auto file = folder.path() / "tint.slang";
  std::ofstream(file) << R"(import workgroup;
import layout;
StructuredBuffer<uint> ids;
StructuredBuffer<uint> triangles;
StructuredBuffer<float> tint;
RWStructuredBuffer<float> colour;
[shader("compute")]
[numthreads(kThreadsPerGroup, 1, 1)]
void shade(uint3 group: SV_GroupID, uint thread: SV_GroupIndex)
{
    for (int k = 0; k < kLanesPerThread; ++k)
    {
        const uint pixel = groupIndex(group) * kLanes + laneOf(k, thread);
        if (pixel >= (frame.rowEnd - frame.rowBegin) * frame.width)
            continue;
        for (uint c = 0; c < 3; ++c)
            colour[3 * pixel + c] = ids[pixel] == kNoTriangle ? 1.0f : tint[3 * triangles[3 * ids[pixel]] + c];
    }
}
)";
  Scene scene = loadInput("generate:icosphere?level=1", 64, 64);
  Stream& tint = scene.makeStream("tint", 3, false);
  for (std::size_t i = 0; i < 3 * scene.vertexCount(); ++i) tint.values.push_back(static_cast<float>(i));
  KernelCache::Options options;
  options.folder = machine.kernels().folder();
  options.files = {{"shade", file}};
  KernelCache kernels(options);
  Rasterizer rasterizer(machine.device(), kernels);
  const Variant variant{{"shade", "id"}, {"route", axes::routeInfo(machine.route()).name}};
  const Framebuffer image = rasterizer.render(scene, variant).image;
  CHECK(image.channels.empty());
  std::size_t painted = 0;
  for (std::size_t k = 0; k < image.pixels(); ++k) {
    if (image.ids[k] == kNoTriangle) continue;
    REQUIRE(image.colour[k].y == tint.values[3 * scene.triangles[image.ids[k]][0] + 1]);
    ++painted;
  }
  CHECK(painted > 100);
  dropStream(scene, false);
  CHECK_THROWS_WITH(rasterizer.render(scene, variant), Catch::Contains("tint"));
}
