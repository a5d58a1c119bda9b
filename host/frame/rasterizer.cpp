#include <fmt/format.h>
#include <tessera/error.h>
#include <tessera/rasterizer.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

#include "host/frame/lighting.h"
#include "host/frame/passes.h"
#include "host/plan/stages.h"

namespace tessera {
namespace {

constexpr std::uint64_t kCornerBytes = 16, kPieceBytes = 40, kItemBytes = 8;  // layout.slang: Corner, Piece, Item
constexpr std::uint64_t kMaxWord = 0xffffffff;                                // kernels index with 32 bits
constexpr std::uint32_t kBlock = 64;          // pixels; bands begin on a row of blocks, and so of cells and tiles
constexpr std::uint32_t kScanBlock = 1024;    // slang/stages/prefix-sum.slang: kChunk
constexpr std::uint32_t kClippedPieces = 26;  // slang/geometry/clip.slang: kMaxCorners - 2
constexpr std::uint64_t kSetupLoops =
    1024;  // iterations of a lane of setup beside its walks over blocks: at most 28 corners at six planes, 78 projected

std::uint64_t ceilDivide(std::uint64_t a, std::uint64_t b) { return (a + b - 1) / b; }

struct Band {
  std::uint32_t begin, end;
};
struct Batch {
  std::size_t first, count;
};

/// One call of render().
class FrameRun {
 public:
  FrameRun(Passes& passes, const Scene& scene, Plan plan, const FrameOptions& options)
      : passes_(passes), device_(passes.device()), info_(device_.info()), scene_(scene), options_(options) {
    frame_.plan = std::move(plan);
    commit_ = &axisValue("commit", value("commit"));
    binning_ = value("binning");
    compact_ = value("compact") == "on";
    tile_ = binning_ == "none" ? kBlock : static_cast<std::uint32_t>(std::stoul(value("tile")));
  }

  Frame run() {
    passes_.prepare(frame_.plan);
    for (const CounterDoc& doc : counterDocs()) frame_.counters[doc.name] = 0;
    Framebuffer& image = frame_.image;
    image.width = scene_.width;
    image.height = scene_.height;
    upload();
    const std::vector<Band> bands = cutBands();
    device_.takeTimes();
    for (const Band& band : bands) {
      batches_ = {{0, scene_.triangles.size()}};
      while (!renderBand(band, bands.size() == 1)) halveBatches();
      addTimes();
      if (options_.readBack) readBack();
    }
    frame_.counters["submitted"] = scene_.triangles.size();
    frame_.counters["bands"] = bands.size();
    return std::move(frame_);
  }

 private:
  std::string value(std::string_view axis) const { return frame_.plan.resolved.get(axis); }
  std::uint64_t pixels() const { return std::uint64_t{scene_.width} * (band_.end - band_.begin); }
  /// Iterations that a lane has left beside `fixed` ones.
  std::uint64_t loopsBeyond(std::uint64_t fixed) const {
    return info_.maxLoopIterations > fixed ? info_.maxLoopIterations - fixed : 0;
  }
  bool fits(std::uint64_t bytes) const { return bytes <= info_.maxBufferBytes; }
  /// Whether tiles have lists of pieces, which can be counted.
  bool listed() const { return binning_ == "queue" || binning_ == "exact"; }

  // ---- what does not depend on the band

  void upload() {
    const std::size_t vertices = scene_.vertexCount();
    if (!fits(vertices * sizeof(glm::vec4)))
      failUnsupported(fmt::format("{}: {} vertices take {} bytes in clip space, its largest buffer holds {}",
                                  info_.name, vertices, vertices * sizeof(glm::vec4), info_.maxBufferBytes));
    passes_.set("vertexCount", static_cast<std::uint32_t>(vertices));
    passes_.set("width", scene_.width);
    const float halfWidth = static_cast<float>(scene_.width) * 0.5f,
                halfHeight = static_cast<float>(scene_.height) * 0.5f;
    passes_.set("halfWidth", halfWidth);
    passes_.set("halfHeight", halfHeight);
    passes_.set("guardX", 32767.0f / halfWidth);
    passes_.set("guardY", 32767.0f / halfHeight);
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column)
        passes_.set(fmt::format("m{}{}", row, column), scene_.clipFromObject[4 * row + column]);
    const auto [light, eye] = lightingOf(scene_.clipFromObject);
    for (const auto& [field, value] : {std::pair{"lightX", light[0]},
                                       {"lightY", light[1]},
                                       {"lightZ", light[2]},
                                       {"eyeX", eye[0]},
                                       {"eyeY", eye[1]},
                                       {"eyeZ", eye[2]},
                                       {"eyeW", eye[3]}})
      passes_.set(field, value);
    if (frame_.plan.transform) {
      passes_.write("positions", scene_.positions);
      passes_.buffer("clipSpace", vertices * sizeof(glm::vec4));
    } else {
      passes_.write("clipSpace", scene_.clip);
    }
    passes_.buffer("corners", vertices * kCornerBytes);
    if (value("shade") == "smooth") passes_.write("normals", scene_.normals);
    if (frame_.plan.attribute) passes_.write("attribute", scene_.attribute);
    passes_.buffer("counters", 8 * kernelCounterCount());
    for (const char* field :
         {"triangleCount", "triangleBase", "extraCapacity", "itemCapacity", "slotCount", "itemCount", "entryCapacity",
          "queueCapacity", "maskWords", "entryBegin", "entryRange", "loadFrame", "commitPass", "scanCount", "scanTop"})
      passes_.set(field, 0u);
  }

  /// Bands of rows whose frame buffers fit the device, and whose blocks a lane of setup can walk within the device's
  /// loop limit: twice the blocks for each piece of a triangle.
  std::vector<Band> cutBands() {
    std::uint64_t pixelBytes = 4;
    for (const auto& [name, bytes] : pixelBuffers())
      if (passes_.uses(name)) pixelBytes = std::max(pixelBytes, bytes);
    const std::uint64_t blocksAcross = ceilDivide(scene_.width, kBlock);
    const std::uint64_t byBytes = info_.maxBufferBytes / (pixelBytes * scene_.width * kBlock);
    // Each loop's last test counts as an iteration; what is clipped and what is not follow one another in one subgroup.
    const std::uint64_t walks = 2 * (frame_.plan.clip ? kClippedPieces + 1 : 1);
    const std::uint64_t byLoops = loopsBeyond(kSetupLoops) / (walks * (blocksAcross + 2));
    const std::uint64_t rows =
        std::min<std::uint64_t>(std::max<std::uint64_t>(std::min(byBytes, byLoops), 1) * kBlock, scene_.height);
    std::vector<Band> bands;
    for (std::uint64_t begin = 0; begin < scene_.height; begin += rows)
      bands.push_back({static_cast<std::uint32_t>(begin),
                       static_cast<std::uint32_t>(std::min<std::uint64_t>(begin + rows, scene_.height))});
    return bands;
  }

  // ---- a band: all batches of triangles

  /// False when a batch needs a buffer larger than the device's: the caller cuts the triangles finer and calls again.
  bool renderBand(const Band& band, bool only) {
    band_ = band;
    passes_.set("rowBegin", band.begin);
    passes_.set("rowEnd", band.end);
    tilesX_ = static_cast<std::uint32_t>(ceilDivide(scene_.width, tile_));
    tilesY_ = static_cast<std::uint32_t>(ceilDivide(band.end - band.begin, tile_));
    passes_.set("tilesX", tilesX_);
    passes_.set("tilesY", tilesY_);
    const bool fitted = std::ranges::all_of(batches_, [&](const Batch& b) { return fits(b.count * kPieceBytes); });
    if (!fitted) return false;
    for (std::size_t b = 0; b < batches_.size(); ++b)
      passes_.write<Triangle>(trianglesOf(b),
                              std::span(scene_.triangles).subspan(batches_[b].first, batches_[b].count));
    device_.takeTimes();  // a band that starts again is timed from its last start; what was lost to finding the cut is
                          // upload

    counted_.clear();
    clear();
    passes_.overElements(frame_.plan.transform ? "transform" : "project", scene_.vertexCount());
    // Ids of the second pass are those of the final depths, so the first pass sees all batches before.
    const std::uint32_t commitPasses = commit_->has(kTwoPasses) ? 2 : 1;
    for (std::uint32_t pass = 0; pass < commitPasses; ++pass)
      for (std::size_t b = 0; b < batches_.size(); ++b) {
        passes_.set("commitPass", pass);
        useBatch(b);
        if (pass == 0 || batches_.size() > 1)
          if (!prepareBatch(only && pass == 0 && batches_.size() == 1)) return false;
        raster(b == 0);
        const bool last = pass + 1 == commitPasses;
        if (last || batches_.size() > 1) countBatch(last);  // else the counters go on over the passes
      }
    if (frame_.plan.resolve) passes_.overElements("resolve", pixels());
    device_.finish();
    times_ = device_.takeTimes();
    if (frame_.plan.shade) {
      for (std::size_t b = 0; b < batches_.size(); ++b) {
        useBatch(b);
        passes_.overElements("shade", pixels());
      }
    }
    if (frame_.plan.attribute) {
      for (std::size_t b = 0; b < batches_.size(); ++b) {
        useBatch(b);
        passes_.overElements("attribute", pixels());
      }
    }
    addCounts();
    if (only && options_.keepStages && batches_.size() == 1) keepFrame();
    return true;
  }

  std::string trianglesOf(std::size_t batch) const { return fmt::format("triangles {}", batch); }

  void useBatch(std::size_t b) {
    passes_.bind("triangles", trianglesOf(b));
    passes_.set("triangleBase", static_cast<std::uint32_t>(batches_[b].first));
    passes_.set("triangleCount", static_cast<std::uint32_t>(batches_[b].count));
  }

  void halveBatches() {
    std::vector<Batch> halves;
    for (const Batch& b : batches_) {
      if (b.count < 2)
        failUnsupported(fmt::format("{}: one triangle needs a buffer larger than its largest, {} bytes", info_.name,
                                    info_.maxBufferBytes));
      halves.push_back({b.first, b.count / 2});
      halves.push_back({b.first + b.count / 2, b.count - b.count / 2});
    }
    batches_ = std::move(halves);
  }

  /// Buffers with an element a pixel, by the names that commits and later stages give them, and its bytes.
  static const std::map<std::string, std::uint64_t>& pixelBuffers() {
    static const std::map<std::string, std::uint64_t> bytes{{"depth", 4},   {"ids", 4},      {"hits", 4},
                                                            {"packed", 8},  {"packed32", 4}, {"locks", 4},
                                                            {"colour", 12}, {"values", 4}};
    return bytes;
  }

  void clear() {
    for (const auto& [name, bytes] : pixelBuffers())
      if (passes_.uses(name)) passes_.buffer(name, pixels() * bytes);
    if (frame_.plan.clear) passes_.overElements("clear", pixels());
  }

  // ---- a batch: setup and bins

  bool prepareBatch(bool keep) {
    if (!setup()) return false;
    if (keep && options_.keepStages) keepSetup();
    if (frame_.plan.payload) {
      passes_.buffer("payloads", 4 * std::uint64_t{passes_.get("triangleCount")});
      passes_.overElements("payload", passes_.get("triangleCount"));
    }
    if (binning_ == "exact") return binExact();
    if (binning_ == "queue") return binQueue();
    largestBin_ = slots();  // aabb-scan, bitmask: a tile goes through them all
    return binning_ != "bitmask" || binMask();
  }
  std::uint64_t slots() const { return passes_.get("slotCount"); }

  std::vector<std::uint32_t> readCounters() {
    return passes_.read<std::uint32_t>("counters", 2 * kernelCounterCount());
  }
  static std::uint64_t count(const std::vector<std::uint32_t>& words, std::string_view name) {
    const std::size_t i = counterIndex(name);
    return words[2 * i] | std::uint64_t{words[2 * i + 1]} << 32;
  }

  bool setup() {
    const std::uint64_t triangles = passes_.get("triangleCount");
    // Where growth starts: an unclipped scene of small triangles has no extras and no items.
    std::uint64_t extras = frame_.plan.clip ? std::max<std::uint64_t>(1024, triangles / 16) : 0;
    std::uint64_t items = std::max<std::uint64_t>(4096, triangles / 16);
    for (;;) {
      if (!fits((triangles + extras) * kPieceBytes) || !fits(items * kItemBytes) ||
          triangles + extras + items > kMaxWord)
        return false;
      passes_.buffer("pieces", (triangles + extras) * kPieceBytes);
      passes_.buffer("items", items * kItemBytes);
      passes_.set("extraCapacity", static_cast<std::uint32_t>(extras));
      passes_.set("itemCapacity", static_cast<std::uint32_t>(items));
      passes_.zero("counters", 2 * kernelCounterCount());
      passes_.overElements("setup", triangles);
      const auto words = readCounters();
      const std::uint64_t extraCount = count(words, "extraPieces"), itemCount = count(words, "items");
      const std::uint64_t slots = compact_ ? count(words, "pieces") : triangles + extraCount;
      passes_.set("slotCount", static_cast<std::uint32_t>(slots));
      passes_.set("itemCount", static_cast<std::uint32_t>(itemCount));
      work_ = slots + itemCount;
      if (extraCount <= extras && itemCount <= items) return true;
      extras = std::max(extras, extraCount);
      items = std::max(items, itemCount);
      if (extraCount > passes_.get("extraCapacity"))
        items = std::max(items, itemCount + itemCount / 4);  // what did not fit had no items counted
      ++counted_["retries"];
    }
  }

  std::uint64_t tiles() const { return std::uint64_t{tilesX_} * tilesY_; }

  /// offsets[t] = sum of tileCounts[0 .. t), and the total behind them.
  void scanTileCounts() {
    std::vector<std::uint64_t> counts{tiles()};
    while (counts.back() > kScanBlock) counts.push_back(ceilDivide(counts.back(), kScanBlock));
    const auto in = [](std::size_t level) {
      return level == 0 ? std::string("tileCounts") : fmt::format("sums {}", level);
    };
    const auto out = [](std::size_t level) {
      return level == 0 ? std::string("offsets") : fmt::format("scanned sums {}", level);
    };
    const auto use = [&](std::size_t level) {
      passes_.buffer(out(level), 4 * (counts[level] + 1));
      passes_.buffer(in(level + 1), 4 * ceilDivide(counts[level], kScanBlock));
      passes_.bind("scanIn", in(level));
      passes_.bind("scanOut", out(level));
      passes_.set("scanCount", static_cast<std::uint32_t>(counts[level]));
      passes_.set("scanTop", level == 0 ? 1u : 0u);
    };
    for (std::size_t level = 0; level < counts.size(); ++level) {
      use(level);
      passes_.bind("scanSums", in(level + 1));
      passes_.overGroups("scan-blocks", ceilDivide(counts[level], kScanBlock));
    }
    for (std::size_t level = counts.size() - 1; level-- > 0;) {
      use(level);
      passes_.bind("scanSums", out(level + 1));
      passes_.overGroups("scan-add", ceilDivide(counts[level], kScanBlock));
    }
  }

  /// Bins at the sizes that tileCounts holds.
  bool insertCounted() {
    scanTileCounts();
    largestBin_ = count(readCounters(), "largestBin");
    if (!entriesFitWord()) return false;
    const std::uint64_t total = passes_.read<std::uint32_t>("offsets", 1, tiles())[0];
    if (!fits(total * 4)) return false;
    binned_ = total;
    passes_.set("queueCapacity", 0u);
    insert(total);
    return true;
  }

  /// Offsets have 32 bits. Only where the bound is past them are the counts themselves added up.
  bool entriesFitWord() {
    if (largestBin_ * tiles() <= kMaxWord) return true;
    std::uint64_t sum = 0;
    for (const std::uint32_t entries : passes_.read<std::uint32_t>("tileCounts", tiles())) sum += entries;
    return sum <= kMaxWord;
  }

  void insert(std::uint64_t entries) {
    passes_.buffer("entries", entries * 4);
    passes_.set("entryCapacity", static_cast<std::uint32_t>(entries));
    passes_.zero("tileCounts", tiles());
    passes_.overElements("bin-insert", work_);
  }

  bool binExact() {
    passes_.buffer("tileCounts", tiles() * 4);
    passes_.zero("tileCounts", tiles());
    passes_.overElements("bin-count", work_);
    return insertCounted();
  }

  bool binMask() {
    const std::uint64_t words = ceilDivide(slots(), 32);
    if (tiles() * words > kMaxWord || !fits(tiles() * words * 4)) return false;
    passes_.buffer("masks", tiles() * words * 4);
    passes_.set("maskWords", static_cast<std::uint32_t>(words));
    passes_.zero("masks", tiles() * words);
    passes_.overElements("bin-insert", work_);
    return true;
  }

  bool binQueue() {
    const std::uint64_t capacity = std::stoul(value("capacity"));
    if (!fits(tiles() * capacity * 4) ||
        tiles() * capacity > kMaxWord)  // kernels have 32 bits for the place of an entry
      failUnsupported(
          fmt::format("capacity={}: {} tiles of it take {} bytes, the largest buffer of {} holds {}; set a smaller "
                      "capacity or a larger tile",
                      capacity, tiles(), tiles() * capacity * 4, info_.name, info_.maxBufferBytes));
    passes_.buffer("tileCounts", tiles() * 4);
    passes_.set("queueCapacity", static_cast<std::uint32_t>(capacity));
    insert(tiles() * capacity);
    largestBin_ = capacity;
    const std::uint64_t overflowed = count(readCounters(), "overflowed");
    if (overflowed == 0 || value("overflow") == "drop") {
      binned_.reset();
      return true;
    }
    if (value("overflow") == "error")
      throw Error(ExitCode::kOverflow,
                  fmt::format("capacity={}: {} bin entries did not fit; set overflow=retry or a larger capacity",
                              capacity, overflowed));
    ++counted_["retries"];
    passes_.zero("counters", 2, 2 * counterIndex("overflowed"));
    return insertCounted();
  }

  // ---- raster

  void raster(bool first) {
    if (binning_ == "none") {
      passes_.overElements("raster-items", work_);
      return;
    }
    // Iterations of a lane: three walks over the tile's cells with the loop over lanes of each, to clear, load and
    // store; and for each entry its rows, their cells, and the lanes of each. A loop of n takes n + 1: lavapipe counts
    // its last test, too.
    const std::uint64_t across = tile_ / 8, cells = across * across;
    const bool once = value("traversal") == "pixel" || value("traversal") == "cell-reject";
    const std::uint64_t each = once ? 3 * cells + 2 * across + 3 : 7 * cells + 10 * across + 9;
    const std::uint64_t fixed = 9 * cells + 16;
    std::uint64_t range = std::max<std::uint64_t>(loopsBeyond(fixed) / each, 1);
    if (binning_ == "bitmask") range = std::max<std::uint64_t>(range / 32 * 32, 32);  // whole words
    passes_.set("entryRange", static_cast<std::uint32_t>(std::min<std::uint64_t>(range, 0x7fffffff)));
    const bool owned = commit_->has(kWritesTiles);
    for (std::uint64_t begin = 0; begin == 0 || begin < largestBin_; begin += range) {
      passes_.set("entryBegin", static_cast<std::uint32_t>(begin));
      passes_.set("loadFrame", owned && first && begin == 0 && !frame_.plan.clear ? 0u : 1u);
      passes_.overGroups("raster-tiles", tiles());
    }
  }

  // ---- what comes back

  /// Setup and bins run again for the second pass of several batches: only what raster did counts in both.
  void countBatch(bool all) {
    const auto words = readCounters();
    for (const CounterDoc& doc : counterDocs()) {
      if (!doc.inKernels || !(all || doc.work)) continue;
      auto& sum = counted_[doc.name];
      const std::uint64_t value = count(words, doc.name);
      sum = doc.name == "largestBin" ? std::max(sum, value) : sum + value;
    }
    if (all && listed()) countBins();
  }

  /// Queues that did not run again have had no scan to count their entries.
  void countBins() {
    if (!binned_) {
      binned_ = 0;
      for (const std::uint32_t entries : passes_.read<std::uint32_t>("tileCounts", tiles())) {
        const std::uint64_t held = std::min<std::uint64_t>(entries, passes_.get("queueCapacity"));
        *binned_ += held;
        counted_["largestBin"] = std::max(counted_["largestBin"], held);
      }
    }
    counted_["binned"] += *binned_;
  }

  /// Causes that belong to a triangle, whatever the band, count once.
  void addCounts() {
    constexpr std::array<std::string_view, 8> once{"badIndex", "nonFinite", "clipped", "outside",
                                                   "behind",   "zeroArea",  "facing",  "betweenSamples"};
    counted_["batches"] = batches_.size();
    for (const auto& [name, value] : counted_) {
      auto& sum = frame_.counters[name];
      if (name == "largestBin" || name == "batches")
        sum = std::max(sum, value);
      else if (band_.begin == 0 || std::ranges::find(once, name) == once.end())
        sum += value;
    }
  }

  void addTimes() {
    if (times_.empty()) return;
    frame_.times.totalNs += times_.back().endNs - times_.front().beginNs;
    const auto shading = device_.takeTimes();
    for (const auto* list : {&std::as_const(times_), &shading})
      for (const StageTime& time : *list) {
        auto& stages = frame_.times.stages;
        auto found = std::ranges::find(stages, time.stage, [](const auto& s) { return s.first; });
        if (found == stages.end()) found = stages.insert(stages.end(), {time.stage, 0});
        found->second += time.endNs - time.beginNs;
      }
  }

  template <typename T>
  void append(std::vector<T>& whole, std::string_view name) {
    const std::vector<T> rows = passes_.read<T>(name, pixels());
    if (whole.empty() && rows.size() < std::size_t{scene_.width} * scene_.height)
      whole.reserve(std::size_t{scene_.width} * scene_.height);
    whole.insert(whole.end(), rows.begin(), rows.end());
  }

  void readBack() {
    Framebuffer& image = frame_.image;
    if (passes_.uses("hits")) append(image.hits, "hits");
    if (passes_.uses("depth")) append(image.depth, "depth");
    if (passes_.uses("ids")) append(image.ids, "ids");
    if (passes_.uses("colour")) append(image.colour, "colour");
    if (passes_.uses("values")) append(image.attribute, "values");
  }

  // ---- stage outputs

  void keep(std::string stage, std::string element, std::size_t words, std::vector<std::uint32_t> values) {
    frame_.stages.push_back({std::move(stage), std::move(element), words, std::move(values)});
  }

  void keepSetup() {
    keep("transform", "vertex, clip x y z w", 4, passes_.read<std::uint32_t>("clipSpace", 4 * scene_.vertexCount()));
    constexpr std::size_t words = kPieceBytes / 4;
    auto pieces = passes_.read<std::uint32_t>("pieces", words * slots());
    // An empty slot holds its id and nothing else; the extras, and all where slots are compact, are in the order in
    // which lanes came.
    const std::size_t placed = compact_ ? 0 : passes_.get("triangleCount");
    std::vector<std::array<std::uint32_t, words>> extras;
    for (std::size_t i = 0; i < slots(); ++i) {
      const auto piece = std::span(pieces).subspan(words * i, words);
      if (piece[words - 1] == kNoTriangle) std::ranges::fill(piece, kNoTriangle);
      if (i < placed) continue;
      std::ranges::copy(piece, extras.emplace_back().begin());
    }
    std::ranges::sort(extras);
    if (!extras.empty()) std::memcpy(pieces.data() + words * placed, extras.data(), extras.size() * kPieceBytes);
    keep("setup", "piece, x0 y0 x1 y1 x2 y2 z0 z1 z2 id", words, std::move(pieces));
  }

  void keepFrame() {
    if (passes_.uses("hits")) return;
    if (listed()) keep("bin", "tile, pieces", 1, passes_.read<std::uint32_t>("tileCounts", tiles()));
    keep("raster", "pixel, depth", 1, passes_.read<std::uint32_t>("depth", pixels()));
    keep("raster", "pixel, id", 1, passes_.read<std::uint32_t>("ids", pixels()));
    if (frame_.plan.attribute) keep("attribute", "pixel, value", 1, passes_.read<std::uint32_t>("values", pixels()));
  }

  Passes& passes_;
  Device& device_;
  const DeviceInfo& info_;
  const Scene& scene_;
  const FrameOptions& options_;
  Frame frame_;
  const AxisValue* commit_ = nullptr;
  std::string binning_;
  bool compact_ = false;
  std::uint32_t tile_ = kBlock, tilesX_ = 0, tilesY_ = 0;
  Band band_{};
  std::vector<Batch> batches_;
  std::uint64_t work_ = 0;               // lanes of binning and of raster by items
  std::uint64_t largestBin_ = 0;         // entries of the fullest tile, or a bound on it
  std::optional<std::uint64_t> binned_;  // of the batch; empty: in queues, not counted yet
  Counters counted_;                     // of the band
  std::vector<StageTime> times_;         // of the band, shading apart
};

}  // namespace

struct Rasterizer::State {
  Passes passes;
};

Rasterizer::Rasterizer(Device& device, KernelCache& kernels) : state_(new State{Passes(device, kernels)}) {}
Rasterizer::~Rasterizer() = default;

Frame Rasterizer::render(const Scene& scene, const Variant& variant, const FrameOptions& options) {
  Variant asked = variant;
  if (options.countWork) asked.set("counters", "work");
  Plan plan = makePlan(scene, asked, state_->passes.device().info());
  return FrameRun(state_->passes, scene, std::move(plan), options).run();
}

}  // namespace tessera
