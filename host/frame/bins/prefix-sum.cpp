#include "host/frame/bins/prefix-sum.h"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace tessera::frame {
namespace {

std::string in(std::size_t level) { return level == 0 ? "tileCounts" : fmt::format("sums {}", level); }
std::string out(std::size_t level) { return level == 0 ? "offsets" : fmt::format("scanned sums {}", level); }

void use(Dispatcher& d, std::size_t level, std::uint64_t elements) {
  d.set("scanCount", static_cast<std::uint32_t>(elements));
  d.set("scanTop", level == 0 ? 1u : 0u);
  d.allocate("scanOut", out(level));
  d.allocate("scanSums", in(level + 1));
  d.bind("scanIn", in(level));
  d.bind("scanOut", out(level));
}

}  // namespace

void sumTileCounts(Dispatcher& d) {
  // A level sums what each group of the level below has summed; the last level is one group.
  std::vector<std::uint64_t> elements{d.count(plan::Extent::kTiles)};
  for (std::size_t level = 0; level < elements.size(); ++level) {
    use(d, level, elements[level]);
    d.bind("scanSums", in(level + 1));
    d.dispatch("scan-blocks");
    if (const std::uint64_t groups = d.count(plan::Extent::kScanGroups); groups > 1) elements.push_back(groups);
  }
  for (std::size_t level = elements.size() - 1; level-- > 0;) {
    use(d, level, elements[level]);
    d.bind("scanSums", out(level + 1));
    d.dispatch("scan-add");
  }
}

}  // namespace tessera::frame
