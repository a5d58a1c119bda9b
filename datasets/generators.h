// Meshes by name and parameters. Positions are made with + - x / and square roots alone, so that they have the same
// bits on every machine, whatever its mathematics library.
#pragma once

#include <tessera/input.h>

#include <glm/vec2.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::datasets {

struct GeneratorParameter {
  std::string name;
  double initial = 0, least = 0, most = 0;
  bool whole = true;                      ///< takes whole numbers only
  std::vector<std::string> choices = {};  ///< if there are any, the value is the place of the chosen word
};

/// Values in the order of the generator's parameters.
using GeneratorValues = std::vector<double>;

struct Generator {
  std::string name;
  std::string makes;
  std::vector<GeneratorParameter> parameters;
  /// x and y from -1 to 1, z from 0 to 1: fills the clip volume under the identity matrix. Others are solids around the
  /// origin.
  bool flat;
  Mesh (*make)(const GeneratorValues&);
};

const std::vector<Generator>& generators();
std::vector<Generator> flatGenerators();
std::vector<Generator> solidGenerators();

struct ParsedGenerator {
  const Generator* generator;
  GeneratorValues values;
};
/// "name?key=value&key=value". Throws kUsage, naming what there is.
ParsedGenerator parseGenerator(std::string_view spec);

/// The point at `part` of the unit circle: (cos, sin) of 2 pi part; an error below 1e-15.
glm::dvec2 circlePoint(double part);

}  // namespace tessera::datasets
