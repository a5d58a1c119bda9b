// binning=none: no bins. A lane rasterises a work item, and commits by atomics.
#include "host/frame/bins/bins.h"

namespace tessera::frame {
namespace {

class None final : public Bins {
 public:
  bool byTiles() const override { return false; }
  bool build(BinsWork&) override { return true; }
  std::uint64_t largest() const override { return 0; }
};

}  // namespace

std::unique_ptr<Bins> makeNone() { return std::make_unique<None>(); }

}  // namespace tessera::frame
