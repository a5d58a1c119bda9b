// The readers behind readMesh(), one a format. Each throws kUsage with "file:place: what is wrong", and gives the zero
// vector for a normal that the file does not give.
#pragma once

#include <tessera/input.h>

#include "datasets/scanner.h"
#include "datasets/text.h"

namespace tessera::datasets {

Mesh readObj(const FileText& file);
Mesh readOff(const FileText& file);
/// The attribute, where it has a name and is no coordinate, is a scalar property of the vertices.
Mesh readPly(const FileText& file, const AttributeRequest& attribute);
/// Binary STL is read piece by piece, since reading it takes less time than filling memory of its size.
Mesh readStl(InputFile& file, const ReadProgress& progress);
/// readMesh() before completeNormals().
Mesh readMeshAsItIs(const std::filesystem::path& path, const AttributeRequest& attribute, const ReadProgress& progress);

}  // namespace tessera::datasets
