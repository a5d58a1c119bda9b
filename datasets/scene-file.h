#pragma once

#include <tessera/input.h>

#include <filesystem>

namespace tessera::datasets {

/// A mesh, and whether it fills clip space as it is (a flat generator).
struct Source {
  Mesh mesh;
  bool flat;
};
/// A mesh file, relative to `folder`, or a generator.
Source loadSource(const std::string& source, const std::filesystem::path& folder, const AttributeRequest& attribute,
                  const ReadProgress& progress);

/// A scene in TOML (datasets/README.md has its keys). `width` and `height`, where not 0, take the place of its size.
Scene readSceneFile(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
                    const AttributeRequest& attribute, const ReadProgress& progress);

}  // namespace tessera::datasets
