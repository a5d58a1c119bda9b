// tessera plan: which passes a scene needs under a variant, and why each other one is left out.
#include "host/plan.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "host/cli/commands.h"
#include "host/cli/common.h"
#include "host/cli/table.h"

namespace tessera::cli {
namespace {

struct PlanOptions : Options {
  bool json = false;
};

std::string planJson(const Plan& plan) {
  nlohmann::ordered_json json{{"plan", nlohmann::ordered_json::array()}, {"variant", plan.resolved.values()}};
  for (const auto& entry : plan.entries)
    json["plan"].push_back({{"pass", entry.pass}, {"kept", entry.kept}, {"why", entry.why}});
  return json.dump(2) + '\n';
}

std::string planTable(const Plan& plan) {
  std::vector<std::vector<std::string>> rows{{"pass", "plan", "why"}};
  for (const auto& entry : plan.entries) rows.push_back({entry.pass, entry.kept ? "kept" : "left out", entry.why});
  return table(rows) + "\nvariant: " + plan.resolved.text() + '\n';
}

ExitCode runPlan(const PlanOptions& options) {
  const Variant variant = variantOf(options);
  const auto device = openDevice(options);
  const Plan plan = makePlan(sceneOf(options), variant, device->info());
  fmt::print("{}", options.json ? planJson(plan) : planTable(plan));
  return ExitCode::kDone;
}

}  // namespace

Command addPlan(CLI::App& app) {
  auto options = std::make_shared<PlanOptions>();
  auto* const command = app.add_subcommand("plan", "say which passes INPUT needs, and why each other one is left out");
  addInput(*command, *options);
  addDevice(*command, *options, false);
  addSettings(*command, *options);
  command->add_flag("--json", options->json, "print JSON");
  command->footer("Example:\n  tessera plan mesh:refined_elephant --set shade=smooth");
  return {command, [options] { return runPlan(*options); }};
}

}  // namespace tessera::cli
