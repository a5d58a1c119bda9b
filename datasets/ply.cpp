// PLY (Turk 1994): vertices, faces and triangle strips out of the data, in text and both byte orders by one walk.
#include <fmt/format.h>

#include <bit>

#include "datasets/attribute.h"
#include "datasets/faces.h"
#include "datasets/huge-pages.h"
#include "datasets/mesh-formats.h"
#include "datasets/ply-data.h"

namespace tessera::datasets {
namespace {

static_assert(std::endian::native == std::endian::little, "PlyBytes turns big-endian numbers alone");

constexpr double kMostMapped = 32767;  // integers of 0 to this fill a range

/// Where a scalar of a vertex goes; a property may be an attribute, too.
struct Target {
  double* position = nullptr;  ///< of the first vertex; each is null where the property is something else
  float* normal = nullptr;
  float* attribute = nullptr;

  bool any() const { return position || normal || attribute; }
  void put(std::uint64_t row, double value) const {
    if (position) position[3 * row] = value;
    if (normal) normal[3 * row] = static_cast<float>(value);
    if (attribute) attribute[row] = static_cast<float>(value);
  }
};

template <class Data>
class Reader {
 public:
  Reader(const FileText& file, const PlyHeader& header, const AttributeRequest& attribute)
      : file_(file), header_(header), request_(attribute), data_(file, header, place_) {}

  Mesh read() {
    for (const PlyElement& element : header_.elements) {
      place_ = {&element};
      if (element.properties.empty()) continue;
      data_.need(element.count, element.properties.size(), element.leastBytes());
      if (element.name == "vertex") {
        readVertices(element);
      } else {
        if (element.name == "face") reserveHuge(mesh_.triangles, mesh_.triangles.size() + element.count);
        readRows(element, {});
      }
    }
    data_.finish();
    faces_.finish();
    return std::move(mesh_);
  }

 private:
  void readVertices(const PlyElement& element) {
    if (element.count >= kBadIndex) data_.fail(fmt::format("indices reach to {} alone", kBadIndex - 1));
    resizeHuge(mesh_.positions, element.count);
    mesh_.float32 = true;
    std::vector<Target> targets(element.properties.size());
    const bool hasNormals = element.find("nx") && element.find("ny") && element.find("nz");
    if (hasNormals) mesh_.normals.resize(element.count);
    const PlyProperty* attribute = nullptr;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      const std::string& name = property.name;
      if (property.count || element.count == 0) continue;
      const auto axis = static_cast<int>(name.back() - 'x');
      if (name == "x" || name == "y" || name == "z") {
        targets[i].position = &mesh_.positions[0][axis];
        mesh_.float32 &= property.type == PlyType::kFloat;
      }
      if (hasNormals && (name == "nx" || name == "ny" || name == "nz")) targets[i].normal = &mesh_.normals[0][axis];
      if (name == request_.name && !request_.isCoordinate()) {
        Stream& stream = mesh_.streams.emplace_back(Stream{name, 1, {}, true});
        stream.values.resize(element.count);
        targets[i].attribute = stream.values.begin();
        attribute = &property;
      }
    }
    readRows(element, targets);
    if (attribute && request_.range && isInteger(attribute->type)) mapAttribute(*attribute);
  }

  void readRows(const PlyElement& element, std::span<const Target> targets) {
    if constexpr (requires { data_.takeBytes(0); }) {
      if (!element.hasLists()) return readColumns(element, targets);
    }
    const auto list =
        std::ranges::find_if(element.properties, [&](const PlyProperty& p) { return isCornerList(element, p); });
    corners_ = {list == element.properties.end() ? nullptr : &*list, element.name == "tristrips"};
    const bool triangles = corners_.property && element.properties.size() == 1 && !corners_.strips;
    for (place_.row = 0; place_.row < element.count; ++place_.row) {
      if constexpr (requires { data_.takeBytes(0); })
        if (triangles)
          place_.row += data_.takeTriangles(*corners_.property, element.count - place_.row,
                                            header_.find("vertex")->count, mesh_.triangles);
      if (place_.row == element.count) break;
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        place_.property = &property;
        if (property.count)
          readList(property);
        else if (!targets.empty() && targets[i].any())
          targets[i].put(place_.row, data_.take(property.type));
        else
          data_.skip(property.type, 1);
      }
    }
  }

  /// Rows of one length: property after property, in blocks that stay in the cache.
  void readColumns(const PlyElement& element, std::span<const Target> targets) {
    const std::size_t stride = element.leastBytes();
    constexpr std::uint64_t kBlock = 1024;
    for (std::uint64_t first = 0; first < element.count; first += kBlock) {
      const std::uint64_t rows = std::min(kBlock, element.count - first);
      const char* at = data_.takeBytes(rows * stride);
      for (std::size_t i = 0; i < targets.size(); at += bytesOf(element.properties[i++].type))
        if (targets[i].any())
          withPlyType(element.properties[i].type, [&](auto zero) {
            for (std::uint64_t row = 0; row < rows; ++row)
              targets[i].put(first + row, static_cast<double>(Data::template load<decltype(zero)>(at + row * stride)));
          });
    }
  }

  void readList(const PlyProperty& property) {
    const double length = data_.take(*property.count);
    if (!(length >= 0 && length == std::floor(length) && length <= 0x1p53))
      data_.fail(fmt::format("a list of length {}", length));
    const auto count = static_cast<std::uint64_t>(length);
    if (&property != corners_.property) return data_.skip(property.type, count);
    data_.need(count, 1, bytesOf(property.type));
    indices_.clear();
    data_.takeAll(property.type, count, [&](double index) {
      if (index != std::floor(index)) data_.fail(fmt::format("{} is not a whole number", index));
      if (corners_.strips && (index == -1 || index == 0xffffffff)) return addStrip();
      indices_.push_back(index >= 0 && index < vertices_ ? static_cast<std::uint32_t>(index) : kBadIndex);
    });
    if (corners_.strips)
      addStrip();
    else
      faces_.add(indices_);
  }

  /// A triangle strip, up to a -1 or the list's end: every other triangle is turned, so that all face the same way.
  void addStrip() {
    if (!indices_.empty() && indices_.size() < 3) faces_.add(indices_);
    for (std::size_t i = 0; i + 2 < indices_.size(); ++i) {
      const std::size_t turned = i % 2;
      faces_.add(std::array{indices_[i + turned], indices_[i + 1 - turned], indices_[i + 2]});
    }
    indices_.clear();
  }

  void mapAttribute(const PlyProperty& property) {
    const double least = request_.range->least, most = request_.range->most;
    std::uint64_t vertex = 0;
    for (float& value : mesh_.streams.back().values) {
      if (!(value >= 0 && value <= kMostMapped))
        failUsage(fmt::format("{}: {} of vertex {}: {} cannot be mapped to a range; integers of 0 to {} can",
                              file_.name, property.name, vertex, value, kMostMapped));
      value = static_cast<float>(least + (most - least) * (static_cast<double>(value) / kMostMapped));
      ++vertex;
    }
  }

  const FileText& file_;
  const PlyHeader& header_;
  const AttributeRequest& request_;
  PlyPlace place_;
  Data data_;
  Mesh mesh_;
  Faces faces_{mesh_};
  const double vertices_ = static_cast<double>(header_.find("vertex")->count);
  struct {
    const PlyProperty* property = nullptr;  ///< the element's list of corners
    bool strips = false;
  } corners_;
  std::vector<std::uint32_t> indices_;  ///< of the face or strip that is being read
};

}  // namespace

Mesh readPly(const FileText& file, const AttributeRequest& attribute) {
  const PlyHeader header = readPlyHeader(file);
  const PlyElement& vertex = *header.find("vertex");
  const PlyProperty* const found = vertex.find(attribute.name);
  if (!attribute.name.empty() && !attribute.isCoordinate() && (!found || found->count)) {
    std::vector<std::string> names = kCoordinates;
    for (const PlyProperty& p : vertex.properties)
      if (!p.count && std::ranges::find(kCoordinates, p.name) == kCoordinates.end()) names.push_back(p.name);
    failAttribute(file.name, attribute.name, names);
  }
  switch (header.format) {
    case PlyHeader::Format::kText:
      return Reader<PlyText>(file, header, attribute).read();
    case PlyHeader::Format::kLittleEndian:
      return Reader<PlyBytes<false>>(file, header, attribute).read();
    default:
      return Reader<PlyBytes<true>>(file, header, attribute).read();
  }
}

}  // namespace tessera::datasets
