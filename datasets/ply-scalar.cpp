// One scalar of the vertices of a PLY file. OpenMesh keeps custom properties in its half-edge mesh alone, so what a
// value raster needs is read here, by the places that the checked header gives.
#include "datasets/ply-scalar.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <map>

#include "datasets/attribute.h"
#include "datasets/checked.h"
#include "datasets/text.h"
#include "host/error.h"

namespace tessera {
namespace {

constexpr double kMostMapped = 32767;  // integers of 0 to this fill a range

/// A number in the file's byte order.
template <typename T>
double decode(const char* at, bool bigEndian) {
  std::array<char, sizeof(T)> bytes;
  std::copy_n(at, sizeof(T), bytes.begin());
  if (bigEndian) std::ranges::reverse(bytes);
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return static_cast<double>(value);
}

struct Type {
  std::size_t bytes;
  bool integer;
  double (*decode)(const char*, bool);
};
template <typename T>
Type typeOf() {
  return {sizeof(T), std::is_integral_v<T>, decode<T>};
}

const std::map<std::string_view, Type>& types() {
  static const std::map<std::string_view, Type> all{
      {"char", typeOf<std::int8_t>()},     {"int8", typeOf<std::int8_t>()},     {"uchar", typeOf<std::uint8_t>()},
      {"uint8", typeOf<std::uint8_t>()},   {"short", typeOf<std::int16_t>()},   {"int16", typeOf<std::int16_t>()},
      {"ushort", typeOf<std::uint16_t>()}, {"uint16", typeOf<std::uint16_t>()}, {"int", typeOf<std::int32_t>()},
      {"int32", typeOf<std::int32_t>()},   {"uint", typeOf<std::uint32_t>()},   {"uint32", typeOf<std::uint32_t>()},
      {"float", typeOf<float>()},          {"float32", typeOf<float>()},        {"double", typeOf<double>()},
      {"float64", typeOf<double>()}};
  return all;
}

/// Words of a text one after another.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}
  std::string_view next() {
    constexpr std::string_view kSpace = " \t\r\n\v\f";
    const std::size_t begin = std::min(text_.find_first_not_of(kSpace, at_), text_.size());
    at_ = std::min(text_.find_first_of(kSpace, begin), text_.size());
    return text_.substr(begin, at_ - begin);
  }
  void skip(std::size_t count) {
    while (count-- > 0) next();
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

std::size_t plyTypeBytes(std::string_view type) {
  const auto found = types().find(type);
  return found == types().end() ? 0 : found->second.bytes;
}

std::vector<float> readPlyScalar(const std::string& name, std::string_view text, const Checked& checked,
                                 const AttributeRequest& attribute) {
  const PlyVertices& ply = checked.ply;
  const auto scalar = std::ranges::find(ply.scalars, attribute.name, &PlyScalar::name);
  if (scalar == ply.scalars.end()) {
    std::vector<std::string> names = kCoordinates;
    for (const PlyScalar& s : ply.scalars)
      if (std::ranges::find(kCoordinates, s.name) == kCoordinates.end()) names.push_back(s.name);
    failAttribute(name, attribute.name, names);
  }
  const Type& type = types().at(scalar->type);
  const std::string_view data = text.substr(ply.header);
  Words words(data);
  if (ply.text) words.skip(ply.before);

  std::vector<float> values;
  values.reserve(checked.vertices);
  for (std::size_t v = 0; v < checked.vertices; ++v) {
    const auto failValue = [&](std::string_view wrong) {
      failUsage(fmt::format("{}: {} of vertex {}: {}", name, attribute.name, v, wrong));
    };
    double value = 0;
    if (ply.text) {
      words.skip(scalar->place);
      const std::string_view word = words.next();
      const auto number = toDouble(word);
      if (!number) failValue(fmt::format("'{}' is not a number", word));
      value = *number;
      words.skip(ply.stride - scalar->place - 1);
    } else {
      const std::size_t at = ply.before + v * ply.stride + scalar->place;
      if (at + type.bytes > data.size()) failValue("the file ends early");
      value = type.decode(data.data() + at, ply.bigEndian);
    }
    if (attribute.range && type.integer) {
      if (!(value >= 0 && value <= kMostMapped))
        failValue(fmt::format("{} cannot be mapped to a range; integers of 0 to {} can", value, kMostMapped));
      const double least = attribute.range->least, most = attribute.range->most;
      value = least + (most - least) * (value / kMostMapped);
    }
    values.push_back(static_cast<float>(value));
  }
  return values;
}

}  // namespace tessera
