#include "host/oracle/oracle-image.h"

#include <string>

namespace tessera::oracle {

ImageAxes imageAxesOf(const Variant& variant) {
  using namespace oracle;
  const std::string cull = variant.get("cull"), interpolate = variant.get("interpolate");
  return {.cull = cull == "back"    ? Cull::kBack
                  : cull == "front" ? Cull::kFront
                                    : Cull::kNone,
          .fill = variant.get("fill") == "inclusive" ? Fill::kInclusive : Fill::kTopLeft,
          .interpolate = interpolate == "plane"     ? Interpolate::kPlane
                         : interpolate == "weights" ? Interpolate::kWeights
                                                    : Interpolate::kCellPlane,
          .subPixelBits = std::stoi(variant.get("sub-pixel", "8"))};
}

}  // namespace tessera::oracle
