#include "experiments/harness/check.h"

#include <fmt/format.h>
#include <tessera/probe.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "experiments/harness/survey.h"
#include "host/axes/settings.h"
#include "host/devices/open.h"
#include "host/images/comparison.h"
#include "host/measure/image-facts.h"
#include "host/measure/kernel-check.h"
#include "host/measure/measure.h"
#include "host/measure/probe-text.h"
#include "host/measure/render-error.h"
#include "host/plan/stages.h"
#include "host/support/table.h"

namespace tessera::harness {
namespace {

constexpr std::size_t kOracleBytes = std::size_t{512} << 20;  // of images kept; two are kept whatever they take

void compile(const Scene& scene, const Variant& asked, const DeviceInfo& device, KernelCache& kernels) {
  for (const Variant& variant : {asked, axes::counting(asked)})
    kernels.getAll(plan::kernelRequests(makePlan(scene, variant, device), kernels.files()));
}

/// Settings that do not go together, with each other or the scene, and a kernel of a stage that the plan leaves out are
/// a refusal as that of a device is. A kernel's file that is none is not: nothing could run it.
Plan planOf(const Scene& scene, const Variant& asked, const DeviceInfo& device, const KernelFiles& files) {
  std::optional<Plan> plan;
  try {
    plan = makePlan(scene, asked, device);
    plan::checkStages(*plan, files);
  } catch (const Error& error) {
    if (error.code() == ExitCode::kUsage) failUnsupported(error.what());
    throw;
  }
  plan::kernelRequests(*plan, files);
  return std::move(*plan);
}

std::string mismatches(const Difference& d) {
  std::string text = fmt::format("differs from the oracle: of {} pixels", support::grouped(d.pixels));
  const char* separator = " ";
  for (const auto& [name, count] : {std::pair{"coverage", d.coverage},
                                    {"ids", d.id},
                                    {"depth", d.depth},
                                    {"hits", d.hits},
                                    {"values", d.attribute}})
    if (count) text += fmt::format("{}{} in {}", std::exchange(separator, ", "), name, support::grouped(*count));
  return text;
}

/// An implementation variant that differs: an error, but where the device's arithmetic promises nothing.
void judge(measure::Run& run, const CheckTools& tools) {
  run.message = mismatches(*run.difference);
  const Probe probe = probeDevice(tools.device, tools.kernels, devices::routeOf(run.device, run.variant));
  if (!probe.passed()) run.message += "; the device's arithmetic fails its probe: " + measure::firstFailure(probe);
  if (probe.passed() || probe.onlyFlushes()) run.status = "error";
}

bool hasMismatch(const std::optional<Difference>& difference) { return difference && !difference->equal(); }

/// Of its own oracle where it differs from that, else of the one that is held to be true.
void writePicture(measure::Run& run, std::size_t number, const Framebuffer& image, const CheckTools& tools) {
  const bool own = hasMismatch(run.difference);
  if (!own && !hasMismatch(run.truthDifference)) return;
  measure::Oracle& oracle = tools.oracles.of(*run.scene, own ? run.variant : axes::joined(run.variant, run.truth));
  const Framebuffer expected = oracle.expected(image);
  run.picture = fmt::format("pictures/{}.png", number);
  try {
    std::filesystem::create_directories(tools.folder / "pictures");
    ImageFacts facts = measure::factsOf(run);
    facts.emplace_back("shows", "differences from the oracle");
    ImageOutput(tools.folder / run.picture)
        .write(
            image.width, image.height,
            [&](std::uint32_t begin, std::uint32_t end, glm::vec3* out) {
              images::paintDifference(expected, image, begin, end, out);
            },
            facts);
  } catch (const Error& error) {  // which has the name
    throw PictureFailed(fmt::format("{}; --resume goes on once there is room", error.what()));
  } catch (const std::exception& error) {
    const auto* const ofFolder = dynamic_cast<const std::filesystem::filesystem_error*>(&error);
    throw PictureFailed(fmt::format("{}: could not be written: {}; --resume goes on once there is room",
                                    (tools.folder / run.picture).string(),
                                    ofFolder ? ofFolder->code().message() : error.what()));
  }
}

}  // namespace

measure::Oracle& Oracles::of(const Scene& scene, const Variant& resolved) {
  const std::string image = imageText(resolved);
  const auto found = std::ranges::find_if(kept_, [&](const Kept& k) { return k.scene == &scene && k.image == image; });
  if (found != kept_.end()) {
    kept_.splice(kept_.begin(), kept_, found);
    return *kept_.front().oracle;
  }
  const std::size_t bytes = std::size_t{scene.width} * scene.height * 16;  // depth, id, hits, value
  std::size_t held = bytes;
  for (const auto& kept : kept_) held += kept.bytes;
  while (held > kOracleBytes && kept_.size() > 1) {
    held -= kept_.back().bytes;
    kept_.pop_back();
  }
  kept_.push_front({&scene, image, bytes, std::make_unique<measure::Oracle>(scene, resolved)});
  return *kept_.front().oracle;
}

bool variesFromRunToRun(const Variant& resolved) { return resolved.get("overflow") == "drop"; }

Difference errorOf(const Scene& scene, const Variant& resolved, const Framebuffer& image, Oracles& oracles) {
  measure::Oracle& oracle = oracles.of(scene, resolved);
  oracle.holdColours({});  // those of another cell say nothing of this one
  return oracle.against(image);
}

double checkCell(measure::Run& run, std::size_t number, const CheckTools& tools) {
  const Scene& scene = *run.scene;
  const Variant asked = run.variant;
  const Plan plan = planOf(scene, asked, run.device, tools.kernels.files());
  run.variant = plan.resolved;
  run.plan = plan.entries;
  compile(scene, asked, run.device, tools.kernels);
  if (!tools.kernels.files().empty()) {
    measure::KernelCheck checked(scene, tools.kernels.files(), {{tools.deviceName, asked}});
    checked.run(tools.frame);
  }

  Rasterizer rasterizer(tools.device, tools.kernels);
  Frame frame;
  run.variant = asked;
  tools.frame([&] { frame = measure::measureRun(run, rasterizer, tools.kernels, 0); });
  run.peakBufferBytes = tools.device.peakBufferBytes();
  Framebuffer& image = frame.image;

  tools.frame([&] {
    const Counters work = rasterizer.render(scene, asked, {.readBack = false, .countWork = true}).counters;
    for (const CounterDoc& doc : counterDocs())
      if (doc.work) run.counters[doc.name] = work.at(doc.name);
  });
  const auto begin = std::chrono::steady_clock::now();
  tools.frame([&] { rasterizer.render(scene, asked, {.readBack = false}); });
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  measure::measureError(run, image);
  std::vector<glm::vec3> colours;
  if (!image.colour.empty() && isApproximate(run.variant)) {
    const Variant exact = measure::exactVariant(asked, run.variant);
    compile(scene, exact, run.device, tools.kernels);
    tools.frame([&] { colours = rasterizer.render(scene, exact).image.colour; });
  }
  measure::Oracle& oracle = tools.oracles.of(scene, run.variant);
  oracle.holdColours(std::move(colours));
  run.difference = oracle.against(image);
  run.wrongWinners = measure::wrongWinners(run.variant, *run.difference, oracle.expected(image), image);
  if (!run.truth.values().empty())
    run.truthDifference = errorOf(scene, axes::joined(run.variant, run.truth), image, tools.oracles);
  writePicture(run, number, image, tools);
  if (!run.difference->equal() && !isApproximate(run.variant)) judge(run, tools);
  return seconds;
}

}  // namespace tessera::harness
