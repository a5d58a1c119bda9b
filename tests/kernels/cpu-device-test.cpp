// The CPU device: what a dispatch sees, in which order groups run, and what is refused.
#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include <tessera/cpu-device.h>

#include "fixture.h"

namespace tessera::test {
namespace {

// One file, four entries. Groups are single lanes, so that the order of groups can be seen.
constexpr const char* kSource = R"(import atomics;
struct Frame { uint count; uint value; float factor; };
struct Pair { uint a; uint64_t b; };
ConstantBuffer<Frame> frame;
RWStructuredBuffer<uint> words;
RWStructuredBuffer<uint> cursor;
RWStructuredBuffer<Pair> pairs;
RWStructuredBuffer<float> floats;
uint linear(uint3 group) { return group.x + group.y * 32768; }
[shader("compute")] [numthreads(1, 1, 1)]
void addValue(uint3 group : SV_GroupID) { const uint i = linear(group); if (i < frame.count) words[i] = words[i] + frame.value; }
[shader("compute")] [numthreads(1, 1, 1)]
void multiply(uint3 group : SV_GroupID) { const uint i = linear(group); if (i < frame.count) words[i] = words[i] * frame.value; }
[shader("compute")] [numthreads(1, 1, 1)]
void record(uint3 group : SV_GroupID) { words[claim(cursor[0])] = linear(group); }
[shader("compute")] [numthreads(1, 1, 1)]
void pairUp(uint3 group : SV_GroupID) { pairs[linear(group)].a = frame.count; pairs[linear(group)].b = frame.value; }
[shader("compute")] [numthreads(1, 1, 1)]
void scale(uint3 group : SV_GroupID) { floats[linear(group)] = floats[linear(group)] * frame.factor; }
[shader("compute")] [numthreads(1, 1, 1)]
void local(uint3 group : SV_GroupID) { uint few[4]; for (uint i = 0; i < 4; ++i) few[i] = i; words[0] = few[frame.value]; }
)";
constexpr const char* kAtomics = R"slang(module atomics;
public uint claim(__ref uint word) { __target_switch { case cpp: __intrinsic_asm "__atomic_fetch_add($0, 1u, __ATOMIC_RELAXED)"; } }
)slang";

struct Frame {
  std::uint32_t count, value;
  float factor;
};

struct Bench {
  Workshop shop;
  KernelCache cache;  // in the folder that all tests share: these sources never change
  std::unique_ptr<Device> device;

  explicit Bench(const CpuOptions& options = {}, bool boundsChecks = false)
      : cache({{}, shop.slang, boundsChecks, ""}), device(makeCpuDevice(options)) {
    writeText(shop.slang / "device.slang", kSource);
    writeText(shop.slang / "atomics.slang", kAtomics);
  }
  std::unique_ptr<Kernel> kernel(const char* entry) {
    return device->createKernel(cache.get({entry, "device.slang", entry, Route::kCpp, {}, ""}));
  }
  void run(const Kernel& kernel, const std::vector<Binding>& bindings, Frame frame, std::uint32_t groups) {
    device->dispatch(kernel, bindings, std::as_bytes(std::span(&frame, 1)), groups);
  }
  template <typename T>
  std::vector<T> read(const Buffer& buffer) {
    std::vector<T> data(buffer.bytes() / sizeof(T));
    device->read(buffer, 0, std::as_writable_bytes(std::span(data)));
    return data;
  }
};

}  // namespace

TEST_CASE("Dispatches run in order over every group once on any number of threads") {
  const std::uint32_t groups = 3 * kGroupRow + 1234;
  for (const CpuOptions& options : {CpuOptions{1}, CpuOptions{2}, CpuOptions{8}, CpuOptions{1, 0, true},
                                    CpuOptions{8, 0, true}, CpuOptions{2, 99}}) {
    Bench bench(options);
    CHECK(bench.device->info().threads == options.threads);
    const auto add = bench.kernel("addValue"), times = bench.kernel("multiply");
    const auto words = bench.device->createBuffer(groups * 4, "words");
    bench.device->fill(*words, 0, groups * 4, 5);
    for (int round = 0; round < 3; ++round) {
      bench.run(*add, {{"words", words.get()}}, {groups, 2, 0}, groups + 7);  // a ragged end: kernels check
      bench.run(*times, {{"words", words.get()}}, {groups, 3, 0}, groups);
    }
    CHECK(bench.read<std::uint32_t>(*words) == std::vector<std::uint32_t>(groups, ((5u + 2) * 3 + 2) * 3 * 3 + 2 * 3));
  }
}

TEST_CASE("Shuffled groups run in another order each time which one thread replays") {
  const auto orders = [](std::uint64_t seed) {
    Bench bench(CpuOptions{1, seed});
    const auto record = bench.kernel("record");
    const auto words = bench.device->createBuffer(1000 * 4, "words"), cursor = bench.device->createBuffer(4, "cursor");
    std::vector<std::vector<std::uint32_t>> result;
    for (int i = 0; i < 2; ++i) {
      bench.device->fill(*cursor, 0, 4, 0);
      bench.run(*record, {{"words", words.get()}, {"cursor", cursor.get()}}, {}, 1000);
      result.push_back(bench.read<std::uint32_t>(*words));
    }
    return result;
  };
  std::vector<std::uint32_t> ascending(1000);
  std::iota(ascending.begin(), ascending.end(), 0u);
  CHECK(orders(0)[0] == ascending);
  const auto first = orders(7), again = orders(7), other = orders(8);
  CHECK(first == again);
  CHECK(first[0] != ascending);
  CHECK(first[0] != first[1]);
  CHECK(first[0] != other[0]);
  for (std::vector<std::uint32_t> order : {first[0], first[1], other[0]}) {
    std::sort(order.begin(), order.end());
    CHECK(order == ascending);
  }
}

TEST_CASE("Buffers and blocks are laid out as the kernel sees them") {
  Bench bench;
  const auto pairUp = bench.kernel("pairUp");
  const auto pairs = bench.device->createBuffer(16 * 10, "pairs");
  bench.device->fill(*pairs, 0, 160, 0);
  CHECK(pairUp->compiled().interface.elementSizes.at("pairs") == 16);
  bench.run(*pairUp, {{"pairs", pairs.get()}, {"extra", nullptr}}, {11, 22, 0}, 10);
  const auto words = bench.read<std::uint64_t>(*pairs);
  for (int i = 0; i < 10; ++i) {
    CHECK(static_cast<std::uint32_t>(words[2 * i]) == 11);
    CHECK(words[2 * i + 1] == 22);
  }
}

TEST_CASE("Kernels keep denormals whatever the caller's thread was set to") {
#if defined(__SSE__)
  Bench bench(CpuOptions{2});
  const auto scale = bench.kernel("scale");
  const std::uint32_t count = 200'000;
  const auto floats = bench.device->createBuffer(count * 4, "floats");
  bench.device->fill(*floats, 0, count * 4, 0x00000100);  // a denormal
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | 0x8040 | 0x6000);  // flush to zero, denormals are zero, round towards zero
  bench.run(*scale, {{"floats", floats.get()}}, {count, 0, 1.5f}, count);
  const unsigned after = _mm_getcsr();
  _mm_setcsr(before);
  CHECK((after & 0xe040) == 0xe040);  // the caller's own settings are given back
  CHECK(bench.read<std::uint32_t>(*floats) == std::vector<std::uint32_t>(count, 0x00000180));
#endif
}

TEST_CASE("Bounds checks name the kernel and the index where they are compiled in") {
  Bench checked(CpuOptions{2}, true);
  const auto pairUp = checked.kernel("pairUp"), local = checked.kernel("local");
  const auto pairs = checked.device->createBuffer(16 * 100, "pairs"), empty = checked.device->createBuffer(0, "pairs");
  checked.run(*pairUp, {{"pairs", pairs.get()}}, {}, 100);
  const std::string line = lineOf(ExitCode::kFailure, [&] { checked.run(*pairUp, {{"pairs", pairs.get()}}, {}, 101); });
  CHECK(contains(line, "kernel pairUp"));
  CHECK(contains(line, "index 100 of 100"));
  CHECK(contains(lineOf(ExitCode::kFailure,
                        [&] {
                          checked.run(*pairUp, {{"pairs", empty.get()}}, {}, 1);
                        }),
                 "index 0 of 0"));
  checked.run(*pairUp, {{"pairs", pairs.get()}}, {}, 100);  // the device goes on
  const auto words = checked.device->createBuffer(4, "words");
  checked.run(*local, {{"words", words.get()}}, {0, 3, 0}, 1);
  CHECK(checked.read<std::uint32_t>(*words).at(0) == 3);
  CHECK(contains(lineOf(ExitCode::kFailure,
                        [&] {
                          checked.run(*local, {{"words", words.get()}}, {0, 4, 0}, 1);
                        }),
                 "index 4 of 4"));
}

TEST_CASE("Misuse of a CPU device is one clear line") {
  Bench bench;
  const auto add = bench.kernel("addValue");
  const auto words = bench.device->createBuffer(100, "words");
  const auto line = [&](const std::function<void()>& action) { return lineOf(ExitCode::kFailure, action); };
  CHECK(contains(line([&] { bench.run(*add, {{"cursor", words.get()}}, {}, 1); }), "nothing is bound to `words`"));
  CHECK(contains(line([&] { bench.run(*add, {{"words", nullptr}}, {}, 1); }), "nothing is bound to `words`"));
  CHECK(contains(line([&] {
                   bench.device->dispatch(*add, std::vector<Binding>{{"words", words.get()}}, {}, 1);
                 }),
                 "`frame` has 12 bytes, 0"));
  std::vector<std::byte> data(101);
  CHECK(contains(line([&] { bench.device->write(*words, 0, data); }), "101 bytes"));
  CHECK(contains(line([&] { bench.device->read(*words, ~std::size_t{0}, std::span(data).first(4)); }), "of 100 bytes"));
  CHECK(contains(line([&] { bench.device->fill(*words, 0, 6, 0); }), "multiples of 4"));
  CHECK(contains(line([&] { bench.device->fill(*words, 4, 100, 0); }), "of 100 bytes"));
  CompiledKernel compiled = add->compiled();
  compiled.entry = "nothing";
  CHECK(contains(line([&] { bench.device->createKernel(compiled); }), "no entry point nothing"));
  compiled.binary = "/no/such/kernel.so";
  CHECK(contains(line([&] { bench.device->createKernel(compiled); }), "/no/such/kernel.so"));
  compiled.route = Route::kSpirv;
  CHECK(contains(line([&] { bench.device->createKernel(compiled); }), "not compiled for a CPU"));
}

TEST_CASE("Writes and fills touch their range alone") {
  Bench bench;
  const std::size_t count = 3'000'000;  // beyond a huge page
  const auto buffer = bench.device->createBuffer(count * 4, "words");
  CHECK(buffer->bytes() == count * 4);
  bench.device->fill(*buffer, 0, count * 4, 1);
  bench.device->fill(*buffer, 4000, 8'000'000, 2);
  const std::vector<std::uint32_t> three(10, 3);
  bench.device->write(*buffer, 400, std::as_bytes(std::span(three)));
  std::vector<std::uint32_t> expected(count, 1);
  std::fill_n(expected.begin() + 1000, 2'000'000, 2u);
  std::copy(three.begin(), three.end(), expected.begin() + 100);
  CHECK(bench.read<std::uint32_t>(*buffer) == expected);
  bench.device->fill(*buffer, 0, 0, 9);
  bench.device->write(*buffer, count * 4, {});
  CHECK(bench.read<std::uint32_t>(*buffer) == expected);
}

TEST_CASE("Times and peak memory are of what ran") {
  Bench bench;
  const std::uint64_t before = bench.device->peakBufferBytes();
  CHECK(before == 0);
  { const auto a = bench.device->createBuffer(1000, "a"), b = bench.device->createBuffer(500, "b"); }
  const auto words = bench.device->createBuffer(400, "words");
  CHECK(bench.device->peakBufferBytes() == 1500);
  const auto add = bench.kernel("addValue"), times = bench.kernel("multiply");
  bench.run(*add, {{"words", words.get()}}, {100, 1, 0}, 100);
  bench.run(*times, {{"words", words.get()}}, {100, 1, 0}, 100);
  bench.run(*times, {{"words", words.get()}}, {100, 1, 0}, 0);
  const std::vector<StageTime> stages = bench.device->takeTimes();
  REQUIRE(stages.size() == 2);
  CHECK(stages[0].stage == "addValue");
  CHECK(stages[1].stage == "multiply");
  CHECK(stages[0].beginNs <= stages[0].endNs);
  CHECK(stages[0].endNs <= stages[1].beginNs);
  CHECK(bench.device->takeTimes().empty());
  const DeviceInfo& info = bench.device->info();
  CHECK(info.api == "cpu");
  CHECK(info.timeClock == "wall");
  CHECK_FALSE(info.name.empty());
  CHECK(contains(info.driver, "++ "));
  CHECK(info.threads >= 1);
}

}  // namespace tessera::test
