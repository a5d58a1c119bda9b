// A frame from the first dispatch to the last: bands, their batches, and at each moment the plan's stages of that
// moment.
#include <fmt/format.h>
#include <tessera/error.h>
#include <tessera/rasterizer.h>

#include <algorithm>
#include <utility>

#include "host/frame/bins/bins.h"
#include "host/frame/cuts.h"
#include "host/frame/dispatcher.h"
#include "host/frame/inputs.h"
#include "host/frame/outputs.h"
#include "host/frame/raster.h"
#include "host/frame/setup.h"
#include "host/frame/tally.h"
#include "host/plan/planner.h"

namespace tessera {
namespace {

/// One call of render().
class FrameRun {
 public:
  FrameRun(frame::Dispatcher& dispatcher, const Scene& scene, Plan plan, const FrameOptions& options)
      : d_(dispatcher),
        device_(dispatcher.device()),
        scene_(scene),
        options_(options),
        settings_(plan::settingsOf(plan.resolved)),
        bins_(frame::makeBins(settings_.binning)) {
    frame_.plan = std::move(plan);
    frame_.image.width = scene.width;
    frame_.image.height = scene.height;
  }
  /// The scene's memory is the caller's again, whether the frame was drawn or failed.
  ~FrameRun() {
    try {
      d_.dropInputs();
    } catch (const Error&) {  // a device that fails here has failed the frame before, and said so
    }
  }
  FrameRun(const FrameRun&) = delete;

  Frame run() {
    d_.prepare(frame_.plan, scene_);
    frame::giveScene(d_, scene_);
    const std::vector<frame::Band> bands = frame::cutBands(scene_, settings_, d_);
    batches_ = {{0, scene_.triangles.size()}};
    device_.takeTimes();
    for (const frame::Band& band : bands) {
      while (!renderBand(band, bands.size() == 1)) batches_ = frame::halved(batches_, device_.info());
      tally_.endBand(band.begin == 0);
      if (options_.readBack) frame::readBand(d_, scene_, frame_.image);
    }
    tally_.counters["submitted"] = scene_.triangles.size();
    tally_.counters["bands"] = bands.size();
    frame_.counters = std::move(tally_.counters);
    frame_.times = std::move(tally_.times);
    d_.dropInputs();
    return std::move(frame_);
  }

 private:
  /// False where a batch needs a buffer larger than the device's largest: the caller cuts the triangles finer and calls
  /// again. `only`: the frame has no other band.
  bool renderBand(const frame::Band& band, bool only) {
    if (!beginBand(band)) return false;
    const bool whole = only && batches_.size() == 1;
    d_.dispatchAll(plan::Moment::kBand);
    // The second pass finds the ids of the final depths, so the first pass goes through all batches before.
    for (unsigned pass = 0; pass < settings_.commit.passes; ++pass)
      for (std::size_t b = 0; b < batches_.size(); ++b)
        if (!renderBatch(b, pass, whole)) return false;
    d_.dispatchAll(plan::Moment::kRaster);
    device_.finish();
    const std::vector<StageTime> visibility = device_.takeTimes();
    shadeBatches();
    tally_.addTotal(visibility);
    tally_.addTimes(visibility);
    tally_.addTimes(device_.takeTimes());
    tally_.count("batches", batches_.size());
    if (whole && options_.keepStages) frame::keepFrame(d_, scene_, *bins_, frame_.stages);
    return true;
  }

  bool beginBand(const frame::Band& band) {
    d_.set("rowBegin", band.begin);
    d_.set("rowEnd", band.end);
    d_.set("tilesX", static_cast<std::uint32_t>(plan::ceilDivide(scene_.width, settings_.tile)));
    d_.set("tilesY", static_cast<std::uint32_t>(plan::ceilDivide(band.end - band.begin, settings_.tile)));
    if (!giveTriangles()) return false;
    device_.takeTimes();  // what was lost to finding the cut is not the band's time
    tally_.beginBand();
    frame_.stages.clear();
    d_.allocateAll(plan::Extent::kPixels);
    return true;
  }

  /// The triangles of each batch, once for each cut.
  bool giveTriangles() {
    d_.set("extraCapacity", 0u);
    for (std::size_t b = 0; b < batches_.size(); ++b) {
      useBatch(b);
      if (!d_.fits("pieces")) return false;
    }
    if (given_ == batches_) return true;
    for (std::size_t b = 0; b < batches_.size(); ++b)
      d_.input(trianglesOf(b), scene_.triangles.span().subspan(batches_[b].first, batches_[b].count));
    given_ = batches_;
    return true;
  }

  static std::string trianglesOf(std::size_t batch) { return fmt::format("triangles {}", batch); }

  void useBatch(std::size_t b) {
    d_.bind("triangles", trianglesOf(b));
    d_.set("triangleBase", static_cast<std::uint32_t>(batches_[b].first));
    d_.set("triangleCount", static_cast<std::uint32_t>(batches_[b].count));
  }

  /// `whole`: the batch is all of the frame.
  bool renderBatch(std::size_t b, unsigned pass, bool whole) {
    d_.set("commitPass", pass);
    useBatch(b);
    // A second pass over the only batch finds its pieces and bins as the first pass left them.
    if ((pass == 0 || batches_.size() > 1) && !prepareBatch(whole && pass == 0)) return false;
    frame::raster(d_, settings_, *bins_, b == 0);
    const bool last = pass + 1 == settings_.commit.passes;
    if (last || batches_.size() > 1) countBatch(last);  // else the counters go on over the passes
    return true;
  }

  bool prepareBatch(bool whole) {
    if (!frame::setUp(d_, settings_, tally_)) return false;
    if (whole && options_.keepStages) frame::keepSetup(d_, scene_, settings_, frame_.stages);
    d_.allocateAll(plan::Extent::kTriangles);
    d_.dispatchAll(plan::Moment::kBatch);
    frame::BinsWork work{d_, tally_, settings_};
    return bins_->build(work);
  }

  void countBatch(bool all) {
    tally_.take(frame::KernelCounters(d_), all);
    frame::BinsWork work{d_, tally_, settings_};
    if (all) bins_->countEntries(work);
  }

  /// The stages behind the visibility buffer. Each batch adds the pixels of its own triangles.
  void shadeBatches() {
    for (std::size_t b = 0; b < batches_.size(); ++b) {
      useBatch(b);
      d_.dispatchAll(plan::Moment::kVisible);
    }
    for (const Stream* stream : interpolatedStreams(scene_)) {
      d_.set("components", stream->components);
      d_.bind("attribute", frame::bufferOf(*stream));
      d_.bind("values", frame::valuesBufferOf(*stream));
      d_.allocate("values", frame::valuesBufferOf(*stream));
      for (std::size_t b = 0; b < batches_.size(); ++b) {
        useBatch(b);
        d_.dispatchAll(plan::Moment::kStreams);
      }
    }
  }

  frame::Dispatcher& d_;
  Device& device_;
  const Scene& scene_;
  const FrameOptions& options_;
  const plan::Settings settings_;
  const std::unique_ptr<frame::Bins> bins_;
  Frame frame_;
  frame::Tally tally_;
  std::vector<frame::Batch> batches_, given_;  // given_: whose triangles the device has
};

}  // namespace

Plan makePlan(const Scene& scene, const Variant& variant, const DeviceInfo& device) {
  return plan::planFrame(scene, variant, device, [](std::string_view name) { return frame::makeBins(name); });
}

struct Rasterizer::State {
  frame::Dispatcher dispatcher;
};

Rasterizer::Rasterizer(Device& device, KernelCache& kernels) : state_(new State{frame::Dispatcher(device, kernels)}) {}
Rasterizer::~Rasterizer() = default;

Frame Rasterizer::render(const Scene& scene, const Variant& variant, const FrameOptions& options) {
  Variant asked = variant;
  if (options.countWork) asked.set("counters", "work");
  Plan plan = makePlan(scene, asked, state_->dispatcher.device().info());
  return FrameRun(state_->dispatcher, scene, std::move(plan), options).run();
}

}  // namespace tessera
