// binning=exact: count the entries of each tile, then make room for exactly so many.
#include "host/frame/bins/lists.h"

namespace tessera::frame {
namespace {

class Exact final : public Lists {
 public:
  std::vector<std::string> stages(const plan::Settings&) const override {
    return {"bin-count", "scan-blocks", "scan-add", "bin-insert"};
  }
  bool build(BinsWork& work) override {
    Dispatcher& d = work.dispatcher;
    d.allocate("tileCounts");
    d.zero("tileCounts");
    d.dispatch("bin-count");
    return insertCounted(work);
  }
};

}  // namespace

std::unique_ptr<Bins> makeExact() { return std::make_unique<Exact>(); }

}  // namespace tessera::frame
