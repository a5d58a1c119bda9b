// binning=queue: each tile has room for `capacity` entries. What does not fit is counted, and retried with room for it.
#include <fmt/format.h>
#include <tessera/error.h>

#include "host/frame/bins/lists.h"

namespace tessera::frame {
namespace {

class Queue final : public Lists {
 public:
  std::vector<std::string> stages(const plan::Settings& settings) const override {
    if (settings.overflow == plan::Overflow::kRetry) return {"scan-blocks", "scan-add", "bin-insert"};
    return {"bin-insert"};
  }
  std::string whyUncounted(const plan::Settings&) const override {
    return "queues have a fixed capacity; only a retry counts and scans";
  }

  bool build(BinsWork& work) override {
    Dispatcher& d = work.dispatcher;
    const std::uint64_t capacity = work.settings.capacity, entries = d.count(plan::Extent::kTiles) * capacity;
    refuseBeyondDevice(d, capacity, entries);
    d.allocate("tileCounts");
    d.set("queueCapacity", static_cast<std::uint32_t>(capacity));
    insert(work, entries);
    largest_ = capacity;
    const std::uint64_t overflowed = KernelCounters(d)["overflowed"];
    if (overflowed == 0 || work.settings.overflow == plan::Overflow::kDrop) {
      binned_.reset();
      return true;
    }
    if (work.settings.overflow == plan::Overflow::kError)
      throw Error(ExitCode::kOverflow,
                  fmt::format("capacity={}: {} bin entries did not fit; set overflow=retry or a larger capacity",
                              capacity, overflowed));
    work.tally.count("retries", 1);
    d.zero("counters", 2, 2 * counterIndex("overflowed"));
    return insertCounted(work);
  }

 private:
  static void refuseBeyondDevice(Dispatcher& d, std::uint64_t capacity, std::uint64_t entries) {
    const DeviceInfo& device = d.device().info();
    if (!d.fits("entries", entries))
      failUnsupported(
          fmt::format("capacity={}: {} tiles of it take {} bytes, the largest buffer of {} holds {}; set a smaller "
                      "capacity or a larger tile",
                      capacity, d.count(plan::Extent::kTiles), entries * 4, device.name, device.maxBufferBytes));
  }
};

}  // namespace

std::unique_ptr<Bins> makeQueue() { return std::make_unique<Queue>(); }

}  // namespace tessera::frame
