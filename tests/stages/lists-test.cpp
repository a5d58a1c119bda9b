// The lists of stages, buffers and extents: what is not in them is an error with its name, and what is in them is whole.
#include <tessera/counters.h>
#include <tessera/cpu-device.h>
#include <tessera/error.h>

#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "host/frame/bins/bins.h"
#include "host/frame/dispatcher.h"
#include "host/plan/buffers.h"
#include "host/plan/planner.h"
#include "host/plan/stages.h"
#include "tests/support/machines.h"

using namespace tessera;
using namespace tessera::test;

namespace {

template <typename Call>
std::string messageOf(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// A binning that asks for a stage that is not there.
class Astray final : public frame::Bins {
 public:
  std::vector<std::string> stages(const plan::Settings&) const override { return {"bin-astray"}; }
  bool build(frame::BinsWork&) override { return true; }
  std::uint64_t largest() const override { return 0; }
};

}  // namespace

TEST_CASE("An unknown stage or buffer or counter or binning is an error with its name") {
  Machine& machine = *machineAt<Cpu>();
  frame::Dispatcher dispatcher(machine.device(), machine.kernels());
  using Catch::Contains;
  CHECK_THAT(messageOf([] { plan::stageOf("bin-astray"); }), Contains("bin-astray"));
  CHECK_THAT(messageOf([] { plan::bufferDoc("astray"); }), Contains("`astray`"));
  CHECK_THAT(messageOf([&] { dispatcher.allocate("astray"); }), Contains("`astray`"));
  CHECK_THAT(messageOf([&] { dispatcher.read<std::uint32_t>("tileCounts", 1); }), Contains("`tileCounts`"));
  CHECK_THAT(messageOf([&] { dispatcher.get("tilesX"); }), Contains("tilesX"));
  CHECK_THAT(messageOf([&] { dispatcher.dispatch("setup"); }), Contains("setup"));
  CHECK_THAT(messageOf([] { counterIndex("astray"); }), Contains("astray"));
  CHECK_THAT(messageOf([] { counterIndex("binned"); }), Contains("binned"));  // the host counts it
  CHECK_THAT(messageOf([] { frame::makeBins("astray"); }), Contains("binning=astray"));
  CHECK_THAT(messageOf([&] {
               plan::planFrame(Scene{}, {}, machine.info(),
                               [](std::string_view) { return std::make_unique<Astray>(); });
             }),
             Contains("bin-astray"));
}

TEST_CASE("Every stage and every buffer of the lists has a name of its own and a size") {
  const std::map<std::string, std::uint64_t, std::less<>> uniforms{
      {"width", 100},     {"rowBegin", 64},     {"rowEnd", 128},      {"tilesX", 2},  {"tilesY", 3},
      {"vertexCount", 5}, {"triangleCount", 7}, {"components", 3},    {"maskWords", 4}, {"extraCapacity", 8},
      {"slotCount", 9},   {"itemCount", 10},    {"itemCapacity", 11}, {"scanCount", 2049}, {"entryCapacity", 12}};
  const plan::UniformValue value = [&](std::string_view name) { return uniforms.find(name)->second; };
  std::set<std::string> names;
  for (const plan::Stage& stage : plan::stages()) {
    INFO(stage.name);
    CHECK(names.insert(stage.name).second);
    CHECK(plan::groupsOf(stage, value) > 0);
    CHECK(!plan::groupFormula(stage).empty());
  }
  names.clear();
  for (const plan::BufferDoc& buffer : plan::buffers()) {
    INFO(buffer.name);
    CHECK(names.insert(buffer.name).second);
    CHECK(buffer.bytes % 4 == 0);
    CHECK(plan::count(buffer.extent, value) > 0);
  }
  CHECK(plan::count(plan::Extent::kScanGroups, value) == 3);
  CHECK(plan::count(plan::Extent::kValues, value) == 3 * 64 * 100);
  for (const Axis& axis : allAxes())
    for (const std::string& stage : axis.stages) CHECK(messageOf([&] { plan::stageOf(stage); }) == "");
}

TEST_CASE("Every binning of the axis has its host half") {
  for (const AxisValue& value : axis("binning").values) {
    INFO(value.name);
    CHECK(frame::makeBins(value.name) != nullptr);
    CHECK(frame::makeBins(value.name)->byTiles() == (value.name != "none"));
  }
}
