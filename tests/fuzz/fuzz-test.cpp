// Mutated files into every reader: each is read, or refused in one line with the exit code of bad input. Nothing
// crashes (under the sanitizers: nothing at all is wrong), nothing hangs, nothing small asks for much memory. The file
// that is being read lies in BUILD/fuzz, where a crash leaves it. TESSERA_FUZZ_MINUTES and TESSERA_FUZZ_SEED in the
// environment ask for more, or for other ones.
#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <tessera/error.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "mutate.h"
#include "seeds.h"

using namespace tessera;
using namespace tessera::test;

namespace {

namespace fs = std::filesystem;

constexpr unsigned kInputs = 1000;     // a target
constexpr unsigned kSecondsEach = 20;  // far more than any needs, with sanitizers on a busy machine
constexpr long kMostMemory = 2048;     // MiB, of the whole program

std::uint64_t numberOf(const char* variable, std::uint64_t otherwise) {
  const char* const text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

void hangs(int) {
  constexpr char kLine[] = "fuzz: a reader has hung; its file lies in the build's folder fuzz\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kLine, sizeof kLine - 1);
  _exit(1);
}

/// What is wrong with a refusal, or nothing.
std::string wrongWith(const Error& error, const fs::path& path) {
  const std::string line = error.what();
  if (error.code() != ExitCode::kUsage) return fmt::format("exit code {}", static_cast<int>(error.code()));
  if (line.find(path.filename().string()) == std::string::npos) return "does not name its file";
  // Control characters of names are the command's to make harmless, where it prints.
  if (line.find('\n') != std::string::npos) return "is more than a line";
  return line.size() > 1000 ? "is long" : "";
}

void readOne(const Target& target, const fs::path& path) {
  std::string wrong;
  alarm(kSecondsEach);
  try {
    target.read(path);
  } catch (const Error& error) {
    wrong = wrongWith(error, path);
    if (!wrong.empty()) wrong += fmt::format(": {}", error.what());
  } catch (const std::exception& error) {
    wrong = fmt::format("{}: {}", typeid(error).name(), error.what());
  }
  alarm(0);
  if (!wrong.empty()) FAIL(wrong);
}

void fuzz(const Target& target, const fs::path& folder) {
  const fs::path path = target.name == "journal" ? folder / "journal.jsonl" : folder / (target.name + target.extension);
  const auto write = [&](const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    REQUIRE(file);
  };
  for (const std::string& seed : target.seeds) {  // which are good as they are
    write(seed);
    REQUIRE_NOTHROW(target.read(path));
  }
  const std::uint64_t minutes = numberOf("TESSERA_FUZZ_MINUTES", 0), first = numberOf("TESSERA_FUZZ_SEED", 1);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(minutes * 60 / 10);  // of ten targets
  for (std::uint64_t seed = first; minutes == 0 ? seed < first + kInputs : std::chrono::steady_clock::now() < end;
       ++seed) {
    datasets::Random random(seed);
    const auto pick = [&]() -> const std::string& { return target.seeds[random.bits() % target.seeds.size()]; };
    const std::string& text = pick();
    write(mutate(text, pick(), random));
    INFO(target.name << ", TESSERA_FUZZ_SEED=" << seed << ": " << path.string());
    readOne(target, path);
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  CHECK(usage.ru_maxrss / 1024 < kMostMemory);
}

}  // namespace

#define FUZZ(NAME)                                                        \
  TEST_CASE("Mutated files: " NAME) {                                     \
    signal(SIGALRM, hangs);                                               \
    const fs::path folder = fs::path(TESSERA_BINARY_DIR) / "fuzz" / NAME; \
    fs::create_directories(folder);                                       \
    for (const Target& target : targets(folder))                          \
      if (target.name == NAME) return fuzz(target, folder);               \
    FAIL("no such target");                                               \
  }
FUZZ("obj")
FUZZ("off")
FUZZ("ply")
FUZZ("ply-values")
FUZZ("stl")
FUZZ("scene")
FUZZ("replay")
FUZZ("image")
FUZZ("sweep")
FUZZ("journal")
