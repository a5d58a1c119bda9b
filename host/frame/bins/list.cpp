// THE list of binnings: the value of the axis, and the host half of it.
#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>

#include "host/frame/bins/bins.h"
#include "host/support/suggest.h"

namespace tessera::frame {

std::unique_ptr<Bins> makeNone();
std::unique_ptr<Bins> makeAabbScan();
std::unique_ptr<Bins> makeQueue();
std::unique_ptr<Bins> makeExact();
std::unique_ptr<Bins> makeBitmask();

namespace {

struct Binning {
  std::string name;
  std::unique_ptr<Bins> (*make)();
};

const std::vector<Binning>& binnings() {
  static const std::vector<Binning> list{{"none", makeNone},
                                         {"aabb-scan", makeAabbScan},
                                         {"queue", makeQueue},
                                         {"exact", makeExact},
                                         {"bitmask", makeBitmask}};
  return list;
}

}  // namespace

std::unique_ptr<Bins> makeBins(std::string_view name) {
  const auto found = std::ranges::find(binnings(), name, &Binning::name);
  if (found != binnings().end()) return found->make();
  fail(fmt::format("binning={}: it has no host half; {}", name,
                   support::whatThereIs(name, support::namesOf(binnings(), &Binning::name))));
}

}  // namespace tessera::frame
