// What a frame is held against: the oracle, pixel by pixel, and where that differs another device, stage by stage.
#pragma once

#include <tessera/image.h>
#include <tessera/rasterizer.h>
#include <tessera/scene.h>

#include <string>
#include <vector>

namespace tessera::measure {

/// The oracle does not shade: without colours from elsewhere there are none to compare.
class Oracle {
 public:
  Oracle(const Scene& scene, const Variant& variant);

  Difference against(const Framebuffer& frame) const;
  /// What the colours of the frames that follow are held against.
  void holdColours(std::vector<glm::vec3> colours) { image_.colour = std::move(colours); }
  bool holdsColours() const { return !image_.colour.empty(); }
  /// The oracle's image reduced to what the frame holds: hits under commit=count, depth and ids
  /// otherwise.
  Framebuffer expected(const Framebuffer& frame) const;

 private:
  Framebuffer image_;
};

/// One line: the first stage, and the first element and word of its output, in which `frame` is not as `good`.
std::string firstStage(const Frame& good, const std::string& goodName, const Frame& frame, const std::string& name);

}  // namespace tessera::measure
