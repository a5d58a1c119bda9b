// The streams of a scene and the channels of a frame, as tests write and read them.
#pragma once

#include <tessera/framebuffer.h>
#include <tessera/input.h>
#include <tessera/scene.h>

#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace tessera::test {

/// The floats of the scene's stream of one float a vertex, to change; the stream is made where there is none.
inline std::vector<float>& attributeOf(Scene& scene) {
  for (Stream& stream : scene.streams)
    if (stream.interpolated) return stream.values.own();
  return scene.makeStream("attribute", 1, true).values.own();
}
inline std::vector<float> attributeOf(const Scene& scene) {
  const Stream* const stream = scene.attribute();
  return stream == nullptr ? std::vector<float>() : std::vector<float>(stream->values.begin(), stream->values.end());
}
inline std::vector<float> attributeOf(const Mesh& mesh) {
  return mesh.streams.empty() ? std::vector<float>()
                              : std::vector<float>(mesh.streams[0].values.begin(), mesh.streams[0].values.end());
}
inline void nameAttribute(Scene& scene, const std::string& name) {
  attributeOf(scene);
  for (Stream& stream : scene.streams)
    if (stream.interpolated) stream.name = name;
}
inline std::string attributeName(const Scene& scene) {
  return scene.attribute() == nullptr ? "" : scene.attribute()->name;
}
inline void dropStream(Scene& scene, bool interpolated) {
  std::erase_if(scene.streams, [&](const Stream& stream) { return stream.interpolated == interpolated; });
}
inline void dropAttribute(Scene& scene) { dropStream(scene, true); }
inline void dropNormals(Scene& scene) { dropStream(scene, false); }

inline std::vector<glm::vec3> normalsOf(const Scene& scene) {
  std::vector<glm::vec3> normals;
  if (const Stream* const stream = scene.stream(kNormals))
    for (std::size_t i = 0; i + 2 < stream->values.size(); i += 3)
      normals.emplace_back(stream->values[i], stream->values[i + 1], stream->values[i + 2]);
  return normals;
}
inline void setNormals(Scene& scene, const std::vector<glm::vec3>& normals) {
  std::vector<float>& values = scene.makeStream(kNormals, 3, false).values.own();
  values.clear();
  for (const glm::vec3& n : normals) values.insert(values.end(), {n.x, n.y, n.z});
}

/// The floats of the frame's first further channel, to change; the channel is made where there is none.
inline std::vector<float>& valuesOf(Framebuffer& frame) {
  if (frame.channels.empty()) frame.makeChannel("attribute", ChannelType::kFloat32, 1);
  return frame.channels.front().floats();
}
inline std::vector<float> valuesOf(const Framebuffer& frame) {
  return frame.channels.empty() ? std::vector<float>() : frame.channels.front().floats();
}

}  // namespace tessera::test
