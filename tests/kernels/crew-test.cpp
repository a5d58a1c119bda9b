// The threads of the CPU device: every element once, exceptions, and as many threads as were asked for.
#include "host/devices/cpu/crew.h"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <vector>

namespace tessera::test {
namespace {

/// Both crews; under the thread sanitizer, which cannot see into oneTBB, the plain one alone.
std::vector<std::unique_ptr<devices::cpu::Crew>> crews(unsigned threads) {
  std::vector<std::unique_ptr<devices::cpu::Crew>> all;
  all.push_back(devices::cpu::makePlainCrew(threads));
#ifndef TESSERA_PLAIN_THREADS
  all.push_back(devices::cpu::makeTbbCrew(threads));
#endif
  return all;
}

}  // namespace

TEST_CASE("Each element is handed out exactly once") {
  for (const unsigned threads : {1u, 2u, 8u})
    for (const auto& crew : crews(threads)) {
      CHECK(crew->threads() == threads);
      for (const std::uint32_t count : {0u, 1u, 2u, 7u, 64u, 100'000u}) {
        std::vector<std::atomic<int>> seen(count);
        std::atomic<bool> sane{true};
        devices::cpu::spread(*crew, count, [&](std::uint32_t begin, std::uint32_t end) {
          if (begin >= end || end > count) sane = false;
          for (std::uint32_t i = begin; i < end; ++i) ++seen[i];
        });
        CHECK(sane);
        CHECK(std::all_of(seen.begin(), seen.end(), [](const std::atomic<int>& times) { return times == 1; }));
      }
    }
}

TEST_CASE("Pieces grow while they are light and are single where they are heavy") {
  const auto crew = devices::cpu::makePlainCrew(1);
  std::uint32_t light = 0, heavy = 0;
  devices::cpu::spread(*crew, 1'000'000, [&](std::uint32_t, std::uint32_t) { ++light; });
  devices::cpu::spread(*crew, 20, [&](std::uint32_t, std::uint32_t) {
    ++heavy;
    const auto end = std::chrono::steady_clock::now() + std::chrono::microseconds(200);
    while (std::chrono::steady_clock::now() < end) {
    }
  });
  CHECK(light < 1000);
  CHECK(heavy == 20);
}

TEST_CASE("An exception stops the work and comes out and the crew goes on") {
  for (const auto& crew : crews(4)) {
    std::atomic<std::uint64_t> elements{0};
    CHECK_THROWS_AS(devices::cpu::spread(*crew, ~0u,
                                         [&](std::uint32_t begin, std::uint32_t end) {
                                           elements += end - begin;
                                           if (begin >= 1000) throw std::runtime_error("enough");
                                         }),
                    std::runtime_error);
    CHECK(elements < ~0u);
    std::atomic<int> after{0};
    devices::cpu::spread(*crew, 500,
                         [&](std::uint32_t begin, std::uint32_t end) { after += static_cast<int>(end - begin); });
    CHECK(after == 500);
  }
}

TEST_CASE("Plain threads all take part at once") {
  const auto crew = devices::cpu::makePlainCrew(8);
  for (int round = 0; round < 3; ++round) {
    std::mutex mutex;
    std::condition_variable changed;
    int inside = 0;
    std::atomic<int> met{0};
    crew->run([&] {
      std::unique_lock lock(mutex);
      if (++inside == 8) changed.notify_all();
      if (changed.wait_for(lock, std::chrono::seconds(20), [&] { return inside == 8; })) ++met;
    });
    CHECK(met == 8);
  }
}

}  // namespace tessera::test
