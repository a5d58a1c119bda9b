#include <fmt/format.h>
#include <tessera/error.h>
#include <tessera/kernel-cache.h>
#include <tessera/probe.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace tessera {
namespace {

constexpr std::uint32_t kLanes = 64;  // slang/machine/workgroup.slang
constexpr std::uint32_t kRandomInputs = 1u << 14;
constexpr const char* kDenormals = "denormals";
constexpr std::uint32_t kIterations = 1u << 17;  // twice what lavapipe 22.3 runs

struct Operands {
  float a, b, c;
};
using Words = std::vector<std::uint32_t>;

std::uint32_t bitsOf(float value) { return std::bit_cast<std::uint32_t>(value); }
/// The smallest normal number among them: where it was rounded up to, a device that flushes may have seen a denormal.
bool isDenormal(float value) { return value != 0 && std::abs(value) <= std::numeric_limits<float>::min(); }

// ---- What the host makes of each operation of slang/stages/probe.slang, in its order. Compiled without contraction.

std::uint32_t comparisons(float a, float b) {
  const std::array bits{(a < b), (a <= b), (a > b), (a >= b), (a == b), (a != b), bool{std::isfinite(a)}};
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < bits.size(); ++i) word |= std::uint32_t{bits[i]} << i;
  return word;
}

bool fitsInt(float a) { return a >= -0x1p31f && a < 0x1p31f; }
bool snaps(float a) { return std::abs(a) < 0x1p24f; }
std::int32_t toInt(std::uint32_t a) { return std::bit_cast<std::int32_t>(a); }
std::uint32_t toUint(std::int32_t a) { return std::bit_cast<std::uint32_t>(a); }

std::int32_t nearestEven(float a) {
  const double whole = std::floor(static_cast<double>(a)), part = a - whole;
  const auto n = static_cast<std::int32_t>(whole);
  return part > 0.5 || (part == 0.5 && n % 2 != 0) ? n + 1 : n;
}

using In = const Operands&;

struct Operation {
  const char* name;  ///< of the result's row; operations of one name share it
  const char* form;  ///< as the kernel has it
  std::uint32_t (*expected)(In);
  bool isFloat = true;  ///< the result is a float: any NaN is as good as another
};

// clang-format off
constexpr std::array kOperations{
    Operation{"add", "a + b", [](In o) { return bitsOf(o.a + o.b); }},
    Operation{"subtract", "a - b", [](In o) { return bitsOf(o.a - o.b); }},
    Operation{"multiply", "a * b", [](In o) { return bitsOf(o.a * o.b); }},
    Operation{"divide", "a / b", [](In o) { return bitsOf(o.a / o.b); }},
    Operation{"divide", "1 / a", [](In o) { return bitsOf(1.0f / o.a); }},
    Operation{"square-root", "sqrt(a)", [](In o) { return bitsOf(std::sqrt(o.a)); }},
    Operation{"floor", "floor(a)", [](In o) { return bitsOf(std::floor(o.a)); }},
    Operation{"compare", "comparisons of a and b", [](In o) { return comparisons(o.a, o.b); }, false},
    Operation{"contraction", "a * b + c", [](In o) { const float p = o.a * o.b; return bitsOf(p + o.c); }},
    Operation{"contraction", "c - a * b", [](In o) { const float p = o.a * o.b; return bitsOf(o.c - p); }},
    Operation{"contraction", "a * b + b * c", [](In o) { const float p = o.a * o.b, q = o.b * o.c; return bitsOf(p + q); }},
    Operation{"int-to-float", "float(int(bits of a))", [](In o) { return bitsOf(float(toInt(bitsOf(o.a)))); }},
    Operation{"uint-to-float", "float(bits of a >> 8)", [](In o) { return bitsOf(float(bitsOf(o.a) >> 8)); }},
    Operation{"float-to-int", "int(a)", [](In o) { return fitsInt(o.a) ? toUint(std::int32_t(o.a)) : 0u; }, false},
    Operation{"snap", "nearestEven(a)", [](In o) { return snaps(o.a) ? toUint(nearestEven(o.a)) : 0u; }, false},
    Operation{"clamp", "clampUnit(a)", [](In o) { return bitsOf(o.a > 0 ? (o.a < 1 ? o.a : 1.0f) : 0.0f); }},
};
// clang-format on

// ---- Inputs

std::vector<Operands> floatInputs() {
  using Limits = std::numeric_limits<float>;
  // clang-format off
  constexpr std::array kEdges{
      0.0f, 0.5f, 1.0f, 1.5f, 2.0f, 2.5f, 3.0f, 1.0f / 3, 255.5f, 0x1p23f - 0.5f, 0x1p23f + 1, 0x1p24f - 1, 0x1p24f,
      0x1p31f - 128, 0x1p31f, 1 - Limits::epsilon() / 2, 1 + Limits::epsilon(), 1e-20f, 1e20f, Limits::denorm_min(),
      Limits::min() - Limits::denorm_min(), Limits::min(), Limits::max(), Limits::infinity(), Limits::quiet_NaN()};
  // clang-format on
  std::vector<Operands> inputs;
  // With c = -(a b), rounded, a b + c is 0 unless the product was kept unrounded: the sharpest test for contraction.
  const auto add = [&](float a, float b) {
    const float product = a * b;
    inputs.push_back({a, b, -product});
  };
  for (float a : kEdges)
    for (float b : kEdges)
      for (float signedA : {a, -a})
        for (float signedB : {b, -b}) add(signedA, signedB);
  std::mt19937 random(1);
  const auto anyBits = [&] { return std::bit_cast<float>(static_cast<std::uint32_t>(random())); };
  const auto anyPixel = [&] { return static_cast<float>(static_cast<std::int32_t>(random())) / 65536; };  // +-32768
  // Half of them denormal.
  const auto anyTiny = [&] { return std::bit_cast<float>(static_cast<std::uint32_t>(random()) & 0x80ffffffu); };
  for (std::uint32_t i = 0; i < kRandomInputs; ++i) {
    switch (i % 4) {
      case 0:
        inputs.push_back({anyBits(), anyBits(), anyBits()});
        break;
      case 1:
        add(anyPixel(), anyPixel());
        break;
      case 2:
        inputs.push_back({anyPixel(), anyPixel(), anyPixel()});
        break;
      default:
        add(anyTiny(), anyPixel());
        break;
    }
  }
  return inputs;
}

std::vector<std::int64_t> wideInputs(std::uint32_t randomInputs) {
  std::vector<std::int64_t> inputs{0, 1, -1, INT64_MAX, INT64_MIN};
  // On and beside each power of two, and what lies half way between two floats there.
  for (int bit = 1; bit < 63; ++bit)
    for (std::int64_t near : {-1, 0, 1})
      for (std::int64_t half : {std::int64_t{0}, std::int64_t{1} << bit >> 24, 3 * (std::int64_t{1} << bit >> 24)})
        for (std::int64_t sign : {-1, 1}) inputs.push_back(sign * ((std::int64_t{1} << bit) + half + near));
  std::mt19937_64 random(2);
  for (std::uint32_t i = 0; i < randomInputs; ++i) {
    const auto bits = static_cast<std::int64_t>(random());
    const int shift = static_cast<int>(random() % 38);
    // Half way between two floats with any 24 bits: 25 bits, the last one set. Or beside it.
    const std::int64_t tie = ((bits & 0xffffff) | 0x1000001) << shift, sign = bits < 0 ? -1 : 1;
    inputs.push_back(i % 2 == 0 ? bits >> shift : sign * tie + static_cast<std::int64_t>(i / 2 % 3) - 1);
  }
  return inputs;
}

// ---- Running

struct Runner {
  Device& device;
  KernelCache& kernels;
  Route route;

  /// Results of an entry point of probe.slang over `count` inputs, with one representation of Wide (a file under
  /// slang/axes).
  Words run(const char* stage, const char* entry, std::uint32_t count, std::string_view operandsName,
            std::span<const std::byte> operands, std::size_t resultWords, std::uint32_t groups,
            const std::string& wide = "wide.two_word") {
    const VariantModules modules{fmt::format("module settings;\n__include {};\n", wide), ""};
    const auto kernel = device.createKernel(kernels.get({stage, "stages/probe.slang", entry, route, modules, ""}));
    const auto in = device.createBuffer(operands.size(), operandsName);
    const auto out = device.createBuffer(resultWords * 4, "results");
    device.write(*in, 0, operands);
    device.fill(*out, 0, resultWords * 4, 0xcdcdcdcd);
    const KernelInterface& interface = kernel->compiled().interface;
    std::vector<std::byte> block(interface.blockSize);
    std::memcpy(block.data() + interface.fields.at("count").offset, &count, sizeof count);
    const Binding bindings[] = {{operandsName, in.get()}, {"results", out.get()}};
    device.dispatch(*kernel, bindings, block, groups);
    Words results(resultWords);
    device.read(*out, 0, std::as_writable_bytes(std::span(results)));
    return results;
  }
};

struct Report {
  std::vector<ProbeResult> results;

  ProbeResult& row(const std::string& name) {
    for (auto& result : results)
      if (result.name == name) return result;
    results.push_back({name, true, true, ""});
    return results.back();
  }
  /// The first difference of a row is told.
  void differs(const std::string& name, const std::string& detail) {
    ProbeResult& result = row(name);
    if (result.passed) result.detail = detail;
    result.passed = false;
  }
};

void probeFloat(Runner& runner, Report& report) {
  const std::vector<Operands> inputs = floatInputs();
  const auto count = static_cast<std::uint32_t>(inputs.size());
  const Words got = runner.run("probe-float", "probeFloat", count, "operands", std::as_bytes(std::span(inputs)),
                               kOperations.size() * count, (count + kLanes - 1) / kLanes);
  for (const Operation& operation : kOperations) report.row(operation.name);
  report.row(kDenormals);
  for (std::size_t op = 0; op < kOperations.size(); ++op) {
    const Operation& operation = kOperations[op];
    for (std::uint32_t i = 0; i < count; ++i) {
      const Operands& o = inputs[i];
      const std::uint32_t expected = operation.expected(o), result = got[op * count + i];
      const float expectedFloat = std::bit_cast<float>(expected);
      if (expected == result ||
          (operation.isFloat && std::isnan(expectedFloat) && std::isnan(std::bit_cast<float>(result))))
        continue;
      // A device that flushes denormals to zero is told so, rather than that it cannot add.
      const bool denormal = isDenormal(o.a) || isDenormal(o.b) || isDenormal(o.c) || isDenormal(o.a * o.b) ||
                            isDenormal(o.b * o.c) || (operation.isFloat && isDenormal(expectedFloat));
      report.differs(denormal ? kDenormals : operation.name,
                     fmt::format("{} with a {:#010x}, b {:#010x}, c {:#010x} gives {:#010x}, should be {:#010x}",
                                 operation.form, bitsOf(o.a), bitsOf(o.b), bitsOf(o.c), result, expected));
    }
  }
}

/// What probeWide() gives for operands a and b, word by word. Native integers must not overflow in C++: halves are
/// added, and factors cut.
constexpr std::array kWideRows{"to-float", "product",  "product", "shift",   "add",  "add",  "subtract", "subtract",
                               "subtract", "subtract", "product", "product", "bits", "bits", "compare"};
std::array<std::uint32_t, kWideRows.size()> wideExpected(std::int64_t a, std::int64_t b) {
  constexpr std::int64_t kLimit = std::int64_t{1} << 30;
  const auto low = [](std::int64_t v) { return static_cast<std::uint32_t>(v); };
  const auto high = [](std::int64_t v) { return static_cast<std::uint32_t>(v >> 32); };
  const std::int64_t words = std::int64_t{toInt(low(a))} * toInt(high(a)), sum = (a >> 1) + (b >> 1);
  const std::int64_t difference = (a >> 1) - (b >> 1), negative = -(a >> 1), product = (a >> 20) * (b >> 46);
  const std::array order{(a < b), (a <= b), (a > b), (a >= b), (a == b), (a != b)};
  std::uint32_t compared = 0;
  for (std::size_t i = 0; i < order.size(); ++i) compared |= std::uint32_t{order[i]} << i;
  return {bitsOf(static_cast<float>(a)),
          low(words),
          high(words),
          low(std::clamp(a >> 8, -kLimit, kLimit)),
          low(sum),
          high(sum),
          low(difference),
          high(difference),
          low(negative),
          high(negative),
          low(product),
          high(product),
          low(a | b),
          high(a | b),
          compared};
}

/// One representation of Wide (slang/math/fixed-point.slang); each result's row is its name and the operation.
void runWide(Runner& runner, Report& report, const std::string& name, const std::string& module,
             const std::vector<std::int64_t>& inputs) {
  const auto count = static_cast<std::uint32_t>(inputs.size());
  std::vector<std::int64_t> operands;
  // With itself, and with its neighbour, which near the powers of two differs in the low word alone.
  for (std::uint32_t i = 0; i < count; ++i)
    operands.insert(operands.end(), {inputs[i], inputs[i % 8 == 0 ? i : (i + 1) % count]});
  const Words got = runner.run("probe-wide", "probeWide", count, "wideOperands", std::as_bytes(std::span(operands)),
                               kWideRows.size() * count, (count + kLanes - 1) / kLanes, module);
  for (const char* row : kWideRows) report.row(name + row);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::int64_t a = operands[2 * i], b = operands[2 * i + 1];
    const auto expected = wideExpected(a, b);
    for (std::size_t word = 0; word < expected.size(); ++word)
      if (const std::uint32_t result = got[word * count + i]; result != expected[word])
        report.differs(name + kWideRows[word],
                       fmt::format("of {} and {} gives {:#010x}, should be {:#010x}", a, b, result, expected[word]));
  }
}

void probeWide(Runner& runner, Report& report, std::uint32_t randomInputs) {
  const std::vector<std::int64_t> inputs = wideInputs(randomInputs);
  runWide(runner, report, "two-word-", "wide.two_word", inputs);
  if (runner.device.info().int64)
    runWide(runner, report, "int64-", "wide.native", inputs);
  else
    report.results.push_back({"int64", false, false, "the device has no 64-bit integers; wide=two-word does without"});
}

void probeLoop(Runner& runner, Report& report) {
  const std::array<std::byte, 4> nothing{};
  const Words got = runner.run("probe-loop", "probeLoop", kIterations, "operands", nothing, 2, 1);
  std::uint32_t hash = 2166136261u;
  for (std::uint32_t i = 0; i < got[0] && i < kIterations; ++i) hash = (hash ^ i) * 16777619u;
  const std::uint32_t needed = std::min(kIterations, runner.device.info().maxLoopIterations);
  report.results.push_back(
      {"loop-limit", false, got[0] >= needed && got[1] == hash,
       fmt::format("{} of {} iterations ran; the host splits work at {}", got[0], kIterations, needed)});
}

}  // namespace

bool Probe::onlyFlushes() const {
  return !passed() && std::ranges::all_of(results, [](const ProbeResult& r) {
    return r.passed || !r.required || r.name == kDenormals;
  });
}

Probe probeWide(Device& device, KernelCache& kernels, Route route, std::uint32_t randomInputs) {
  Runner runner{device, kernels, route};
  Report report;
  probeWide(runner, report, randomInputs);
  return {std::move(report.results)};
}

Probe probeDevice(Device& device, KernelCache& kernels, Route route) {
  Runner runner{device, kernels, route};
  Report report;
  probeFloat(runner, report);
  probeWide(runner, report, kRandomInputs);
  probeLoop(runner, report);
  return {std::move(report.results)};
}

}  // namespace tessera
