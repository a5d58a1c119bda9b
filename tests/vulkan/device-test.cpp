// The promises of host/include/tessera/device.h on a Vulkan device, with memory mapped and copied, validation layer on.
#include <tessera/error.h>
#include <tessera/kernel-cache.h>
#include <tessera/vulkan-device.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cctype>
#include <cstring>
#include <numeric>

using namespace tessera;

namespace {

using Words = std::vector<std::uint32_t>;

KernelCache& kernelCache() {
  static KernelCache cache([] {
    KernelCache::Options options;
    options.slangSources = TESSERA_SOURCE_DIR "/tests/vulkan";
    return options;
  }());
  return cache;
}

/// A device whose validation messages fail the test.
struct Machine {
  std::vector<std::string> messages;
  std::unique_ptr<Device> device;

  explicit Machine(bool staged = false, bool boundsChecks = false) {
    VulkanOptions options;
    options.validation = true;
    options.staged = staged;
    options.boundsChecks = boundsChecks;
    options.onMessage = [this](const std::string& message) { messages.push_back(message); };
    device = makeVulkanDevice(options);
  }
  ~Machine() {
    device.reset();
    CHECK(messages == std::vector<std::string>{});
  }

  std::unique_ptr<Kernel> kernel(const std::string& entry) {
    return device->createKernel(kernelCache().get({entry, "device-kernels.slang", entry, Route::kSpirv, {}, ""}));
  }
  std::unique_ptr<Buffer> buffer(const Words& words) {
    auto made = device->createBuffer(words.size() * 4, "words");
    device->write(*made, 0, std::as_bytes(std::span(words)));
    return made;
  }
  Words words(const Buffer& buffer) {
    Words read(buffer.bytes() / 4);
    device->read(buffer, 0, std::as_writable_bytes(std::span(read)));
    return read;
  }
};

std::vector<std::byte> block(const Kernel& kernel, std::uint32_t count, std::uint32_t value) {
  const KernelInterface& interface = kernel.compiled().interface;
  std::vector<std::byte> bytes(interface.blockSize);
  std::memcpy(bytes.data() + interface.fields.at("count").offset, &count, 4);
  std::memcpy(bytes.data() + interface.fields.at("value").offset, &value, 4);
  return bytes;
}

Words counted(std::uint32_t count, std::uint32_t first = 0) {
  Words words(count);
  std::iota(words.begin(), words.end(), first);
  return words;
}

template <class Work>
void fails(ExitCode code, const std::string& says, Work&& work) {
  try {
    work();
    FAIL("no Error; expected: " << says);
  } catch (const Error& error) {
    CHECK(error.code() == code);
    CHECK_THAT(error.what(), Catch::Contains(says));
    CHECK_THAT(error.what(), !Catch::Contains("\n"));
  }
}

}  // namespace

TEST_CASE("what is written is read, whole and in parts") {
  for (bool staged : {false, true}) {
    Machine m(staged);
    const Words values = counted(5'000'000, 7);  // more than one staging buffer
    const auto buffer = m.buffer(values);
    CHECK(m.words(*buffer) == values);
    const Words part{1, 2, 3};
    m.device->write(*buffer, 400, std::as_bytes(std::span(part)));
    Words read(5);
    m.device->read(*buffer, 396, std::as_writable_bytes(std::span(read)));
    CHECK(read == Words{106, 1, 2, 3, 110});
  }
}

TEST_CASE("fill sets a range and no more") {
  for (bool staged : {false, true}) {
    Machine m(staged);
    const auto buffer = m.buffer(counted(100));
    m.device->fill(*buffer, 40, 80, 0xdeadbeef);
    m.device->fill(*buffer, 44, 0, 1);
    Words expected = counted(100);
    std::fill_n(expected.begin() + 10, 20, 0xdeadbeef);
    CHECK(m.words(*buffer) == expected);
  }
}

TEST_CASE("what is recorded runs in order and each dispatch has its own block") {
  for (bool staged : {false, true}) {
    Machine m(staged);
    constexpr std::uint32_t kCount = 1000, kGroups = 16;
    const auto kernel = m.kernel("scaleAdd");
    const auto a = m.buffer(Words(kCount, 0)), b = m.buffer(Words(kCount, 1));
    Words expectedA(kCount, 5), expectedB(kCount, 1);
    m.device->fill(*a, 0, 4 * kCount, 5);
    // More than one submission holds, so that the recording runs by itself in between.
    for (std::uint32_t i = 0; i < 2500; ++i) {
      const bool first = i % 3 == 0;
      m.device->dispatch(*kernel, std::array{Binding{"cells", first ? a.get() : b.get()}}, block(*kernel, kCount, i),
                         kGroups);
      for (auto& word : first ? expectedA : expectedB) word = word * 3 + i;
    }
    const Words last{42};
    m.device->write(*b, 0, std::as_bytes(std::span(last)));
    expectedB[0] = 42;
    CHECK(m.words(*a) == expectedA);
    CHECK(m.words(*b) == expectedB);
    CHECK(m.device->takeTimes().size() == 2500);
  }
}

TEST_CASE("a dispatch sees what other lanes of the one before wrote") {
  Machine m;
  constexpr std::uint32_t kCount = 1u << 18, kGroups = kCount / 64;
  const auto scale = m.kernel("scaleAdd"), reverse = m.kernel("reverse");
  const auto from = m.buffer(counted(kCount)), to = m.buffer(Words(kCount));
  m.device->dispatch(*scale, std::array{Binding{"cells", from.get()}}, block(*scale, kCount, 1), kGroups);
  m.device->dispatch(*reverse,
                     std::array{Binding{"cells", to.get()}, Binding{"source", from.get()}, Binding{"unknown", nullptr}},
                     block(*reverse, kCount, 0), kGroups);
  Words expected(kCount);
  for (std::uint32_t i = 0; i < kCount; ++i) expected[i] = (kCount - 1 - i) * 3 + 1;
  CHECK(m.words(*to) == expected);
}

TEST_CASE("every group runs once below and above a row of groups") {
  Machine m;
  const auto kernel = m.kernel("markGroups");
  for (std::uint32_t groups : {0u, 1u, 32767u, 32769u, 65535u, 65536u, 200'001u}) {
    const auto cells = m.buffer(Words(groups, 3));
    m.device->dispatch(*kernel, std::array{Binding{"cells", cells.get()}}, block(*kernel, groups, 10), groups);
    CHECK(m.words(*cells) == counted(groups, 13));
  }
}

TEST_CASE("a buffer may go before what was recorded with it runs") {
  Machine m;
  const auto kernel = m.kernel("scaleAdd");
  const auto kept = m.buffer(Words(64, 1));
  {
    const auto gone = m.buffer(Words(64, 1));
    const auto goneKernel = m.kernel("scaleAdd");
    m.device->dispatch(*goneKernel, std::array{Binding{"cells", gone.get()}}, block(*kernel, 64, 1), 1);
  }
  m.device->dispatch(*kernel, std::array{Binding{"cells", kept.get()}}, block(*kernel, 64, 1), 1);
  CHECK(m.words(*kept) == Words(64, 4));
}

TEST_CASE("times have one entry a dispatch in order and on one clock") {
  Machine m;
  constexpr std::uint32_t kCount = 1u << 20;
  const auto scale = m.kernel("scaleAdd"), mark = m.kernel("markGroups");
  const auto cells = m.buffer(Words(kCount));
  const auto run = [&](const Kernel& kernel, std::uint32_t groups) {
    m.device->dispatch(kernel, std::array{Binding{"cells", cells.get()}}, block(kernel, kCount, 1), groups);
  };
  run(*scale, kCount / 64);
  run(*mark, 1);
  m.device->finish();
  run(*scale, kCount / 64);
  const auto times = m.device->takeTimes();
  REQUIRE(times.size() == 3);
  CHECK(times[0].stage == "scaleAdd");
  CHECK(times[1].stage == "markGroups");
  CHECK(times[2].stage == "scaleAdd");
  for (std::size_t i = 0; i < 3; ++i) CHECK(times[i].beginNs <= times[i].endNs);
  for (std::size_t i = 0; i < 2; ++i) CHECK(times[i].endNs <= times[i + 1].beginNs);
  CHECK(times[0].endNs - times[0].beginNs > 1000);  // a million cells in under a microsecond is no clock
  CHECK(times[2].endNs - times[0].beginNs < 60'000'000'000);
  CHECK(m.device->takeTimes().empty());
}

TEST_CASE("64-bit atomic minimum where the device has it") {
  Machine m;
  if (!m.device->info().atomicMin64) {
    fails(ExitCode::kUnsupported, "64-bit", [&] { m.kernel("atomicMinWide"); });
    return;
  }
  const auto kernel = m.kernel("atomicMinWide");
  const auto wide = m.buffer({~0u, ~0u});
  m.device->dispatch(*kernel, std::array{Binding{"wide", wide.get()}}, {}, 1);
  CHECK(m.words(*wide) == Words{63, 937});
}

TEST_CASE("wrong use is one clear line") {
  Machine m;
  const auto kernel = m.kernel("scaleAdd");
  const auto cells = m.buffer(Words(64));
  const Words word{1};
  fails(ExitCode::kFailure, "kernel scaleAdd: nothing is bound to 'cells'", [&] {
    m.device->dispatch(*kernel, std::array{Binding{"cell", cells.get()}}, block(*kernel, 64, 1), 1);
  });
  fails(ExitCode::kFailure, "uniform block of 2 bytes was given, it has", [&] {
    m.device->dispatch(*kernel, std::array{Binding{"cells", cells.get()}}, std::array<std::byte, 2>{}, 1);
  });
  fails(ExitCode::kUnsupported, "4294967295 groups", [&] {
    m.device->dispatch(*kernel, std::array{Binding{"cells", cells.get()}}, block(*kernel, 64, 1), ~0u);
  });
  fails(ExitCode::kFailure, "write of 4 bytes at 253 of buffer 'words', which has 256",
        [&] { m.device->write(*cells, 253, std::as_bytes(std::span(word))); });
  fails(ExitCode::kFailure, "fill of 3 bytes at 0", [&] { m.device->fill(*cells, 0, 3, 0); });
  fails(ExitCode::kUnsupported, "buffer 'huge'", [&] { m.device->createBuffer(~std::size_t{0} - 8, "huge"); });
  fails(ExitCode::kUnsupported, "bytes of group memory", [&] { m.kernel("hugeGroupMemory"); });
  fails(ExitCode::kFailure, "not a SPIR-V module", [&] {
    CompiledKernel text = kernel->compiled();
    text.binary = TESSERA_SOURCE_DIR "/README.md";
    m.device->createKernel(text);
  });
  // None of it was recorded, and the device goes on.
  m.device->dispatch(*kernel, std::array{Binding{"cells", cells.get()}}, block(*kernel, 64, 1), 1);
  CHECK(m.words(*cells) == Words(64, 1));
}

TEST_CASE("the validation layer is there and its messages arrive") {
  Machine m;
  CompiledKernel wrong = m.kernel("scaleAdd")->compiled();
  auto& resources = wrong.interface.resources;
  std::swap(resources.at("frame"), resources.at("cells"));  // a uniform block where the module has a storage buffer
  m.device->createKernel(wrong);
  CHECK(!m.messages.empty());
  m.messages.clear();
}

TEST_CASE("two devices live in one process and outlive each other's buffers") {
  auto one = std::make_unique<Machine>();
  Machine two;
  const auto ofOne = one->buffer(counted(64)), ofTwo = two.buffer(counted(64, 100));
  const auto kernelOne = one->kernel("scaleAdd"), kernelTwo = two.kernel("scaleAdd");
  one->device->dispatch(*kernelOne, std::array{Binding{"cells", ofOne.get()}}, block(*kernelOne, 64, 1), 1);
  two.device->dispatch(*kernelTwo, std::array{Binding{"cells", ofTwo.get()}}, block(*kernelTwo, 64, 2), 1);
  CHECK(one->words(*ofOne)[5] == 16);
  one.reset();  // before its buffer and its kernel
  CHECK(two.words(*ofTwo)[5] == 317);
}

TEST_CASE("a device with bounds checks says what index is out of range") {
  for (const bool staged : {false, true}) {
    Machine m(staged, true);
    const auto kernel = m.kernel("writeAt");
    const auto cells = m.buffer({7, 7, 7}), empty = m.device->createBuffer(0, "empty");
    const auto write = [&](const Buffer& buffer, std::uint32_t count, std::uint32_t value, std::uint32_t groups = 1) {
      m.device->dispatch(*kernel, std::array{Binding{"cells", &buffer}}, block(*kernel, count, value), groups);
    };
    const auto outOfBounds = [&](const std::string& says, auto&&... what) {
      fails(ExitCode::kFailure, "vulkan: kernel writeAt: out of bounds: index " + says, [&] { write(what...); });
    };
    write(*cells, 0, 2);
    outOfBounds("3 of 3 elements of `cells`", *cells, 0, 3);
    outOfBounds("2147483647 of 3 elements of `cells`", *cells, 0, 0x7fffffff);
    outOfBounds("-1 of 3 elements of `cells`", *cells, 0, 0xffffffff);
    outOfBounds("0 of 0 elements of `cells`", *empty, 0, 0);
    outOfBounds("4294967296 of 3 elements of `few`", *cells, 1, 1);
    outOfBounds("3 of 3 elements of `few`", *cells, 0, 1, 4);
    write(*cells, 0, 1);  // a fault does not stay
    const Words after = m.words(*cells);
    CHECK((after[1] == 0 && after[2] == 0));
  }
}

TEST_CASE("a kernel sees a buffer of the length that was asked for") {
  for (const bool boundsChecks : {false, true}) {
    Machine m(false, boundsChecks);
    const auto kernel = m.kernel("askLength");
    for (const std::uint32_t length : {1u, 3u, 64u, 1000u}) {
      const auto cells = m.buffer(Words(length, 7));
      m.device->dispatch(*kernel, std::array{Binding{"cells", cells.get()}}, block(*kernel, 0, 0), 1);
      CHECK(m.words(*cells)[0] == length);
    }
  }
}

TEST_CASE("peak bytes follow the buffers held") {
  Machine m;
  const std::uint64_t before = m.device->peakBufferBytes();
  for (int i = 0; i < 3; ++i) m.device->createBuffer(1u << 20, "short-lived");
  CHECK(m.device->peakBufferBytes() == before + (1u << 20));
  const auto empty = m.device->createBuffer(0, "empty");
  CHECK(empty->bytes() == 0);
}

TEST_CASE("adapters are listed and selected by index and by part of the name") {
  const auto adapters = listVulkanAdapters().adapters;
  REQUIRE(!adapters.empty());
  for (std::size_t i = 0; i < adapters.size(); ++i) CHECK(adapters[i].index == i);
  const VulkanAdapter& first = adapters[0];
  REQUIRE(first.whyNot.empty());
  const auto select = [](const std::string& by) {
    VulkanOptions options;
    options.select = by;
    return makeVulkanDevice(options)->info().name;
  };
  std::string shouted = first.name.substr(0, 6);
  for (char& c : shouted) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  CHECK(select("0") == first.name);
  CHECK(select(shouted) == first.name);
  fails(ExitCode::kUsage, "vulkan:99: no such device; there are: 0 " + first.name, [&] { select("99"); });
  fails(ExitCode::kUsage, "vulkan:no-such-adapter", [&] { select("no-such-adapter"); });
  fails(ExitCode::kUsage, "no such device", [&] { select("99999999999999999999"); });
}

TEST_CASE("lavapipe says what it is") {
  const auto present = listVulkanAdapters().adapters;
  for (const auto& adapter : present) {
    if (adapter.name.find("llvmpipe") == std::string::npos) continue;
    VulkanOptions options;
    options.select = std::to_string(adapter.index);
    const auto device = makeVulkanDevice(options);
    CHECK(device->info().correctnessOnly);
    CHECK(device->info().maxLoopIterations == 65535);
    CHECK(device->info().timeClock == "timestamp");
    CHECK(device->info().maxBufferBytes >= 128u << 20);
  }
}

TEST_CASE("SwiftShader is there without being asked for and chosen only by name") {
  const auto adapters = listVulkanAdapters().adapters;
  const auto isSwiftShader = [](const VulkanAdapter& a) { return a.name.find("SwiftShader") != std::string::npos; };
  REQUIRE(std::count_if(adapters.begin(), adapters.end(), isSwiftShader) == 1);
  CHECK(isSwiftShader(adapters.back()));
  CHECK(makeVulkanDevice({})->info().name.find("SwiftShader") == std::string::npos);
  VulkanOptions options;
  options.select = "swiftshader";
  const auto device = makeVulkanDevice(options);
  CHECK(device->info().correctnessOnly);
  CHECK(!device->info().int64);
  CHECK(!device->info().float64);
  CHECK(!device->info().atomicMin64);
  try {
    device->createKernel(
        kernelCache().get({"atomicMinWide", "device-kernels.slang", "atomicMinWide", Route::kSpirv, {}, ""}));
    FAIL("64-bit atomics on SwiftShader");
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::kUnsupported);
  }
}
