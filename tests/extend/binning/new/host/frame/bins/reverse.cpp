// binning=reverse: no bins. Each tile looks at every piece, the last one first.
#include "host/frame/bins/bins.h"

namespace tessera::frame {
namespace {

class Reverse final : public Bins {
 public:
  bool build(BinsWork& work) override {
    slots_ = work.dispatcher.get("slotCount");
    return true;
  }
  std::uint64_t largest() const override { return slots_; }

 private:
  std::uint64_t slots_ = 0;
};

}  // namespace

std::unique_ptr<Bins> makeReverse() { return std::make_unique<Reverse>(); }

}  // namespace tessera::frame
