// tessera plan: which passes a scene needs under a variant, and why each other one is left out.
#include <fmt/format.h>
#include <tessera/plan.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "host/cli/commands.h"
#include "host/cli/common.h"
#include "host/devices/open.h"
#include "host/plan/choice.h"
#include "host/plan/stages.h"
#include "host/support/table.h"
#include "host/support/terminal.h"

namespace tessera::cli {
namespace {

struct PlanOptions : Options {
  bool json = false;
};

/// `files`: a user's, by stage; a pass that runs one says so.
std::string planJson(const Plan& plan, const KernelFiles& files) {
  nlohmann::ordered_json json{{"plan", nlohmann::ordered_json::array()},
                              {"variant", plan::settable(plan.resolved).values()}};
  for (const auto& entry : plan.entries)
    json["plan"].push_back({{"pass", entry.pass}, {"kept", entry.kept}, {"why", entry.why}});
  for (const auto& [stage, file] : files) json["kernels"][stage] = file.string();
  return json.dump(2) + '\n';
}

std::string planTable(const Plan& plan, const KernelFiles& files) {
  std::vector<std::vector<std::string>> rows{{"pass", "plan", "why"}};
  for (const auto& entry : plan.entries) rows.push_back({entry.pass, entry.kept ? "kept" : "left out", entry.why});
  std::string text = support::table(rows) + "\nvariant: " + plan::settable(plan.resolved).text() + '\n';
  for (const auto& [stage, file] : files) text += fmt::format("kernel of {}: {}\n", stage, file.string());
  return text;
}

ExitCode runPlan(const PlanOptions& options) {
  const Variant variant = variantOf(options);
  const KernelFiles files = kernelFilesOf(options);
  const auto device = deviceOf(options);
  const Plan plan = makePlan(sceneOf(options), variant, device->info());
  plan::kernelRequests(plan,
                       files);  // refuses a file of a stage that the plan leaves out, or that the device cannot take
  support::say(stdout, "{}", options.json ? planJson(plan, files) : planTable(plan, files));
  return ExitCode::kDone;
}

}  // namespace

Command addPlan(CLI::App& app) {
  auto options = std::make_shared<PlanOptions>();
  auto* const command = app.add_subcommand("plan", "say which passes INPUT needs, and why each other one is left out");
  addInput(*command, *options);
  addDevice(*command, *options, false);
  addSettings(*command, *options);
  addAttribute(*command, *options);
  addKernelFiles(*command, *options);
  addThreads(*command, *options);
  command->add_flag("--json", options->json, "print JSON");
  addQuiet(*command, options->quiet);
  command->footer(
      "The line 'variant:' has the value of each axis that says something, set or chosen; --set takes it as it "
      "stands, in quotes.\n\n"
      "Example:\n  tessera plan mesh:refined_elephant --set shade=smooth");
  return {command, [options] { return runPlan(*options); }};
}

}  // namespace tessera::cli
