// binning=bitmask: a bit for each pair of a tile and a slot.
#include <fmt/format.h>
#include <tessera/error.h>

#include <cmath>

#include "host/frame/bins/all-slots.h"

namespace tessera::frame {
namespace {

constexpr double kMostMaskBytes = 4294967296.0;  // 4 GiB
constexpr std::uint64_t kWordBits = 32;

class Bitmask final : public AllSlots {
 public:
  void check(const plan::BinsLoad& load, const DeviceInfo& device) const override {
    const double bytes = load.tiles * std::ceil(load.triangles / kWordBits) * 4;
    if (bytes > kMostMaskBytes)
      failUsage(
          fmt::format("binning=bitmask: a bit for each of {} tiles and {} triangles takes {:.1f} GiB; up to "
                      "{:.0f} GiB would be taken: set a larger tile, or binning=exact",
                      load.tiles, load.triangles, bytes / 0x1p30, kMostMaskBytes / 0x1p30));
    if (bytes > double(device.maxBufferBytes))
      failUnsupported(
          fmt::format("binning=bitmask: a bit for each of {} tiles and {} triangles takes {:.0f} MiB, the "
                      "largest buffer of {} holds {:.0f}; set a larger tile, or binning=exact",
                      load.tiles, load.triangles, bytes / 0x1p20, device.name, double(device.maxBufferBytes) / 0x1p20));
  }
  std::vector<std::string> stages(const plan::Settings&) const override { return {"bin-insert"}; }
  bool build(BinsWork& work) override {
    Dispatcher& d = work.dispatcher;
    AllSlots::build(work);
    d.set("maskWords", static_cast<std::uint32_t>(plan::ceilDivide(largest(), kWordBits)));
    if (!d.fits("masks")) return false;
    d.allocate("masks");
    d.zero("masks");
    d.dispatch("bin-insert");
    return true;
  }
  std::uint64_t rangeStep() const override { return kWordBits; }
};

}  // namespace

std::unique_ptr<Bins> makeBitmask() { return std::make_unique<Bitmask>(); }

}  // namespace tessera::frame
