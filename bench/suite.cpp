#include "bench/suite.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>
#include <string_view>

#include "bench/scenes.h"
#include "host/devices/open.h"
#include "host/support/terminal.h"

namespace tessera::bench {
namespace {

constexpr std::string_view kDevice = "--device=";

std::unique_ptr<Device> open(const std::string& name) {
  if (devices::findKind(name) == nullptr)
    failUsage(fmt::format("{}{}: no such device; {} would be", kDevice, name, devices::deviceForms()));
  return openDevice(name);
}

}  // namespace

benchmark::Counter rate(std::size_t count) {
  return benchmark::Counter(static_cast<double>(count), benchmark::Counter::kIsIterationInvariantRate);
}

int runSuite(const char* program, int argc, char** argv, const std::function<void(Machine&)>& add) try {
  benchmark::Initialize(&argc, argv);
  std::string device = devices::defaultDevice();
  for (int i = 1; i < argc; ++i) {
    if (!std::string_view(argv[i]).starts_with(kDevice)) continue;
    device = std::string_view(argv[i]).substr(kDevice.size());
    std::move(argv + i + 1, argv + argc, argv + i);
    --argc, --i;
  }
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return static_cast<int>(ExitCode::kUsage);
  Machine machine(open(device));
  for (const auto& [name, value] : provenance(machine.device->info(), machine.kernels))
    benchmark::AddCustomContext(name, value);  // Debian's library says of itself that it is a debug build
  add(machine);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
} catch (const Error& error) {
  support::say(stderr, "{}: {}\n", program, error.what());
  return static_cast<int>(error.code());
}

}  // namespace tessera::bench
