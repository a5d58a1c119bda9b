// What a user would not expect of an input, one line each, for the scene's notes.
#pragma once

#include <string>
#include <vector>

#include "datasets/placing.h"

namespace tessera::datasets {

/// Of a mesh whose vertices stand in the scene from `first` on: that it shows nothing, or how coarse float32 is for it.
void noteMesh(Scene& scene, const PlacedMesh& placed, const std::vector<bool>& drawn, std::size_t first);

/// That a camera sees none of the scene's triangles, where one of its planes shows it.
void noteUnseen(Scene& scene, const std::string& file);

}  // namespace tessera::datasets
