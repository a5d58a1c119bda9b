// The header of a PLY file: what lies in its data, in which order.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/scanner.h"

namespace tessera::datasets {

enum class PlyType : std::uint8_t { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };
std::size_t bytesOf(PlyType type);
bool isInteger(PlyType type);
std::string_view nameOf(PlyType type);  ///< the shorter of its two names

struct PlyProperty {
  std::string name;
  PlyType type;
  std::optional<PlyType> count;  ///< of a list: the type of its length
};
struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  const PlyProperty* find(std::string_view property) const;
  bool hasLists() const;
  std::size_t leastBytes() const;  ///< of one, in binary: of its scalars, and of its lists' lengths
};
struct PlyHeader {
  enum class Format { kText, kLittleEndian, kBigEndian };
  Format format = Format::kText;
  std::vector<PlyElement> elements;
  std::size_t bytes = 0;  ///< the data follow

  const PlyElement* find(std::string_view element) const;
};

/// Anything in the header that the format does not allow is refused, and so is a mesh that has no x, y and z or whose
/// faces have no list of corners.
PlyHeader readPlyHeader(const FileText& file);

/// Is this element's list of this name one of corners? Faces have one, and triangle strips.
bool isCornerList(const PlyElement& element, const PlyProperty& property);

}  // namespace tessera::datasets
