#include "datasets/attribute.h"

#include <fmt/format.h>

#include "host/error.h"
#include "host/suggest.h"

namespace tessera {

void failAttribute(const std::string& place, const std::string& name, const std::vector<std::string>& present) {
  failUsage(fmt::format("{}: no attribute '{}'; {}", place, name, whatThereIs(name, present)));
}

void setCoordinates(Scene& scene, const AttributeRequest& attribute) {
  scene.attributeName = attribute.name;
  if (!attribute.isCoordinate()) return;
  const int axis = attribute.name[0] - 'x';
  for (const glm::vec3& p : scene.positions) scene.attribute.push_back(p[axis]);
}

}  // namespace tessera
