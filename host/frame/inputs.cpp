#include "host/frame/inputs.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include "host/frame/lighting.h"
#include "host/plan/buffers.h"

namespace tessera::frame {
namespace {

constexpr char kStream[] = "stream ", kValues[] = "values ";  // no buffer of the pipeline begins so

/// A program may give its streams ever new names. What the scene no longer has would stay as long as the rasterizer.
void dropFormerStreams(Dispatcher& d, const Scene& scene) {
  d.drop([&](std::string_view buffer) {
    for (const std::string_view kind : {kStream, kValues})
      if (buffer.starts_with(kind)) return scene.stream(buffer.substr(kind.size())) == nullptr;
    return false;
  });
}

void setUniforms(Dispatcher& d, const Scene& scene) {
  d.set("vertexCount", static_cast<std::uint32_t>(scene.vertexCount()));
  d.set("width", scene.width);
  const float halfWidth = static_cast<float>(scene.width) * 0.5f, halfHeight = static_cast<float>(scene.height) * 0.5f;
  d.set("halfWidth", halfWidth);
  d.set("halfHeight", halfHeight);
  d.set("guardX", 32767.0f / halfWidth);
  d.set("guardY", 32767.0f / halfHeight);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      d.set(fmt::format("m{}{}", row, column), scene.clipFromObject[4 * row + column]);
  const auto [light, eye] = lightingOf(scene.clipFromObject);
  for (const auto& [field, value] : {std::pair{"lightX", light[0]},
                                     {"lightY", light[1]},
                                     {"lightZ", light[2]},
                                     {"eyeX", eye[0]},
                                     {"eyeY", eye[1]},
                                     {"eyeZ", eye[2]},
                                     {"eyeW", eye[3]}})
    d.set(field, value);
  // What a part of the frame sets before it dispatches; a dispatch copies the whole block.
  for (const char* field : {"triangleCount", "triangleBase", "extraCapacity", "itemCapacity", "slotCount", "itemCount",
                            "entryCapacity", "queueCapacity", "maskWords", "entryBegin", "entryRange", "loadFrame",
                            "commitPass", "scanCount", "scanTop", "components"})
    d.set(field, 0u);
}

}  // namespace

std::string bufferOf(const Stream& stream) { return kStream + stream.name; }
std::string valuesBufferOf(const Stream& stream) { return kValues + stream.name; }

void giveScene(Dispatcher& d, const Scene& scene) {
  dropFormerStreams(d, scene);
  setUniforms(d, scene);
  if (!d.fits("clipSpace"))
    failUnsupported(fmt::format("{}: {} vertices take {} bytes in clip space, its largest buffer holds {}",
                                d.device().info().name, scene.vertexCount(), d.bytesOf("clipSpace"),
                                d.device().info().maxBufferBytes));
  if (d.plan().runs("transform"))
    d.input("positions", scene.positions.span());
  else
    d.input("clipSpace", scene.clip.span());
  d.allocateAll(plan::Extent::kVertices);
  d.allocate("counters");
  for (const Stream& stream : scene.streams)
    if (stream.interpolated || d.uses(stream.name)) {
      d.input(bufferOf(stream), stream.values.span());
      // A stream may be called as a buffer of the pipeline is; then kernels mean the buffer.
      if (plan::findBuffer(stream.name) == nullptr) d.bind(stream.name, bufferOf(stream));
    }
}

}  // namespace tessera::frame
