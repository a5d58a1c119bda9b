#include "datasets/generators.h"

#include <cmath>

#include "datasets/normals.h"

namespace tessera {

namespace datasets {

const std::vector<Generator>& generators() {
  static const std::vector<Generator> all = [] {
    std::vector<Generator> list = solidGenerators();
    for (Generator& generator : flatGenerators()) list.push_back(std::move(generator));
    return list;
  }();
  return all;
}

}  // namespace datasets

Mesh generateMesh(const std::string& spec) {
  const auto [generator, values] = datasets::parseGenerator(spec);
  Mesh mesh = generator->make(values);
  datasets::completeNormals(mesh);
  return mesh;
}

namespace datasets {

glm::dvec2 circlePoint(double part) {
  // The eighth of the circle that is nearest to an axis, by Taylor series: at most pi/4, where term 18 is below 1e-17.
  const double quarter = std::floor(part * 4 + 0.5);
  const double angle = (part - quarter / 4) * 6.283185307179586;
  const double square = angle * angle;
  double cosine = 1, sine = 1;
  for (int k = 16; k >= 2; k -= 2) {
    cosine = 1 - cosine * square / (k * (k - 1));
    sine = 1 - sine * square / (k * (k + 1));
  }
  sine *= angle;
  switch (static_cast<long>(quarter) & 3) {
    case 0:
      return {cosine, sine};
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    default:
      return {sine, -cosine};
  }
}

}  // namespace datasets

}  // namespace tessera
