// The visibility buffer and what is resolved from it, on the host.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tessera {

inline constexpr std::uint32_t kUnknownTriangle =
    0xfffffffeu;  ///< covered, by a commit that keeps no ids (depth32+rgba8, depth24+lum8)
inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;  ///< id of an empty pixel; its depth is 1.0

/// Of an attribute: what a picture's colours span, and what errors are relative to.
struct ValueRange {
  float least = 0;  ///< in the attribute's unit
  float most = 1;   ///< in the attribute's unit, not equal to `least`
};

/// What a value of a channel is.
enum class ChannelType { kFloat32, kUint32 };

/// A named raster with 1 to 4 values a pixel: of a stream of the scene, or of a stage that makes one.
struct Channel {
  std::string name;                                                   ///< unique in its frame
  unsigned components = 1;                                            ///< values a pixel
  std::variant<std::vector<float>, std::vector<std::uint32_t>> data;  ///< components * pixels() of them

  /// What the values are.
  ChannelType type() const { return data.index() == 0 ? ChannelType::kFloat32 : ChannelType::kUint32; }
  /// The values of a float32 channel.
  const std::vector<float>& floats() const { return std::get<0>(data); }
  /// The same, to change.
  std::vector<float>& floats() { return std::get<0>(data); }
};

/// One raster of a framebuffer, whichever member holds it.
struct ChannelView {
  std::string_view name;             ///< the channel's, or the member's
  ChannelType type;                  ///< of each value
  unsigned components;               ///< values a pixel
  std::span<const std::byte> bytes;  ///< 4 * components * pixels
};

/// An image on the host. Row-major, row 0 at the top, width * height elements in each vector that is not empty.
struct Framebuffer {
  std::uint32_t width = 0;          ///< pixels
  std::uint32_t height = 0;         ///< pixels
  std::vector<float> depth;         ///< [+0, 1]; empty under commit=count
  std::vector<std::uint32_t> ids;   ///< triangle id or kNoTriangle; empty under commit=count
  std::vector<std::uint32_t> hits;  ///< triangles that cover the sample; only under commit=count
  std::vector<glm::vec3> colour;    ///< linear RGB, [0, 1]; only when shading was asked for
  /// One for each stream of the scene that is interpolated, under the stream's name and in the scene's order: float32,
  /// NaN (0x7fc00000) in empty pixels and where a vertex' value is not finite.
  std::vector<Channel> channels = {};

  /// width * height.
  std::size_t pixels() const { return std::size_t{width} * height; }
  /// Null where there is no such channel.
  const Channel* channel(std::string_view name) const;
  /// All that there is but what is empty: depth, ids, hits, colour, then `channels`.
  std::vector<ChannelView> views() const;
  /// The channel of that name, made where there is none.
  Channel& makeChannel(std::string_view name, ChannelType type, unsigned components);
  /// The first channel of one float32 a pixel, which pictures show; empty where there is none.
  std::span<const float> values() const;
};

}  // namespace tessera
