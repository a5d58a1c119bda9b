#include <tessera/framebuffer.h>

#include <algorithm>

namespace tessera {
namespace {

template <typename T>
void add(std::vector<ChannelView>& views, std::string_view name, ChannelType type, unsigned components,
         const std::vector<T>& values) {
  if (!values.empty()) views.push_back({name, type, components, std::as_bytes(std::span(values))});
}

/// `act(name, type, components, values)` for each member that holds a raster, in the order of views().
template <typename Frame, typename Act>
void eachMember(Frame& frame, Act act) {
  using enum ChannelType;
  act("depth", kFloat32, 1u, frame.depth);
  act("ids", kUint32, 1u, frame.ids);
  act("hits", kUint32, 1u, frame.hits);
  act("colour", kFloat32, 3u, frame.colour);
}

}  // namespace

const Channel* Framebuffer::channel(std::string_view name) const {
  const auto found = std::ranges::find(channels, name, &Channel::name);
  return found == channels.end() ? nullptr : &*found;
}

Channel& Framebuffer::makeChannel(std::string_view name, ChannelType type, unsigned components) {
  const auto found = std::ranges::find(channels, name, &Channel::name);
  if (found != channels.end()) return *found;
  Channel made{std::string(name), components, {}};
  if (type == ChannelType::kUint32) made.data = std::vector<std::uint32_t>();
  return channels.emplace_back(std::move(made));
}

RasterMember Framebuffer::member(std::string_view name) {
  RasterMember found;
  eachMember(*this, [&](std::string_view one, ChannelType, unsigned, auto& values) {
    if (one == name) found = &values;
  });
  return found;
}

std::vector<ChannelView> Framebuffer::views() const {
  std::vector<ChannelView> views;
  eachMember(*this, [&](std::string_view name, ChannelType type, unsigned components, const auto& values) {
    add(views, name, type, components, values);
  });
  for (const Channel& c : channels)
    std::visit([&](const auto& values) { add(views, c.name, c.type(), c.components, values); }, c.data);
  return views;
}

std::span<const float> Framebuffer::values() const {
  const auto found = std::ranges::find_if(
      channels, [](const Channel& c) { return c.type() == ChannelType::kFloat32 && c.components == 1; });
  return found == channels.end() ? std::span<const float>() : std::span<const float>(found->floats());
}

}  // namespace tessera
