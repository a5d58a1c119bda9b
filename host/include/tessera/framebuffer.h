// The visibility buffer, and what is resolved from the visibility buffer, on the host.
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
    0xfffffffeu;  ///< id of a covered pixel under a commit that keeps no ids (depth32+rgba8, depth24+lum8)
inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;  ///< id of an empty pixel; its depth is 1.0

/// The range of an attribute: a picture's colours span the range, and errors are relative to the range.
struct ValueRange {
  float least = 0;  ///< in the attribute's unit
  float most = 1;   ///< in the attribute's unit, not equal to `least`
};

/// The type of a channel's values, each of which has 32 bits.
enum class ChannelType { kFloat32, kUint32 };

/// A named raster with 1 to 4 values for each pixel. A channel comes from a stream of the scene, or from a stage that
/// makes a channel.
struct Channel {
  std::string name;         ///< the name of the stream, or of the buffer that a stage writes
  unsigned components = 1;  ///< values for each pixel
  std::variant<std::vector<float>, std::vector<std::uint32_t>> data;  ///< components * Framebuffer::pixels() values

  /// The type of the values.
  ChannelType type() const { return data.index() == 0 ? ChannelType::kFloat32 : ChannelType::kUint32; }
  /// The values of a float32 channel.
  const std::vector<float>& floats() const { return std::get<0>(data); }
  /// The values of a float32 channel, to be changed.
  std::vector<float>& floats() { return std::get<0>(data); }
};

/// One raster of a framebuffer, whichever member of the framebuffer holds the raster.
struct ChannelView {
  std::string_view name;             ///< `depth`, `ids`, `hits`, `colour`, or Channel::name
  ChannelType type;                  ///< the type of the values
  unsigned components;               ///< values for each pixel
  std::span<const std::byte> bytes;  ///< 4 * components * pixels bytes
};

/// A member of a framebuffer that holds a raster; std::monostate where there is none.
using RasterMember =
    std::variant<std::monostate, std::vector<float>*, std::vector<std::uint32_t>*, std::vector<glm::vec3>*>;

/// An image on the host. Each vector that is not empty has width * height elements, row-major, with row 0 at the top.
struct Framebuffer {
  std::uint32_t width = 0;          ///< pixels
  std::uint32_t height = 0;         ///< pixels
  std::vector<float> depth;         ///< in [+0, 1]; empty under commit=count
  std::vector<std::uint32_t> ids;   ///< triangle id, kNoTriangle or kUnknownTriangle; empty under commit=count
  std::vector<std::uint32_t> hits;  ///< how many triangles cover the sample; only under commit=count
  std::vector<glm::vec3> colour;    ///< linear RGB in [0, 1]; only where shading was asked for
  /// One channel for each stream of the scene that is interpolated, under the stream's name and in the scene's order.
  /// The values are float32, and NaN (0x7fc00000) in empty pixels and where a vertex' value is not finite.
  std::vector<Channel> channels = {};

  /// width * height.
  std::size_t pixels() const { return std::size_t{width} * height; }
  /// The channel `name`. Null where the framebuffer has no channel of this name.
  const Channel* channel(std::string_view name) const;
  /// All rasters that are not empty: depth, ids, hits, colour, then `channels`.
  std::vector<ChannelView> views() const;
  /// The member that views() calls `name`, empty or not; std::monostate where no member has the name.
  RasterMember member(std::string_view name);
  /// The channel `name`; makes the channel where the framebuffer has none of this name.
  Channel& makeChannel(std::string_view name, ChannelType type, unsigned components);
  /// The values of the first channel with one float32 for each pixel; pictures show this channel. Empty where the
  /// framebuffer has no such channel.
  std::span<const float> values() const;
};

}  // namespace tessera
