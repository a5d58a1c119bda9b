// What the device's own graphics pipeline makes of a scene: one vkCmdDrawIndexed into a visibility buffer, R32_UINT
// triangle id and D32_SFLOAT depth, test LESS, nothing culled. A peer to measure against, not an oracle: snapping and
// depth are the driver's own.
#pragma once

#include <tessera/framebuffer.h>
#include <tessera/scene.h>

#include <cstdint>
#include <memory>
#include <string>

namespace tessera::bench {

struct DrawTime {
  std::uint64_t deviceNs = 0;  ///< between timestamps around the clear and the draw
  std::uint64_t wallNs = 0;    ///< from submission until the host sees it finished
};

class DrawBaseline {
 public:
  /// Uploads the scene's clip-space vertices and its indices. `select` as in VulkanOptions. Throws Error: kUnsupported
  /// where the device lacks what it takes, kUsage for an index out of range (undefined in a draw).
  explicit DrawBaseline(const Scene& scene, const std::string& select = "", bool validation = false);
  ~DrawBaseline();
  DrawBaseline(const DrawBaseline&) = delete;

  std::string device() const;
  /// Clears and draws once.
  DrawTime time();
  /// Depth and ids of the last draw; draws if there was none.
  Framebuffer framebuffer();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tessera::bench
