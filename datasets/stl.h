#pragma once

#include <string>
#include <string_view>

#include "datasets/input.h"

namespace tessera {

/// STL, binary or text, facets in order; corners with the same bits share a vertex. OpenMesh's reader is not used: it
/// joins corners that are merely close, leaves out facets that this makes degenerate (so that ids move), and takes a
/// binary file whose header begins with "solid" for text. Normals are not taken from the file: they belong to facets.
Mesh readStl(const std::string& name, std::string_view text);

}  // namespace tessera
