// PLY files of any shape for tests: a header as text, and the same numbers in each format.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::test {

inline const std::vector<std::string> kPlyFormats{"ascii", "binary_little_endian", "binary_big_endian"};
inline const std::vector<std::string> kPlyTypes{"char",   "int8",    "uchar",  "uint8",  "short", "int16",
                                                "ushort", "uint16",  "int",    "int32",  "uint",  "uint32",
                                                "float",  "float32", "double", "float64"};

class PlyData {
 public:
  explicit PlyData(std::string format) : format_(std::move(format)) {}

  PlyData& put(std::string_view type, double value) {
    if (format_ == "ascii") {
      char word[32];
      std::snprintf(word, sizeof word, "%.12g ", value);
      bytes_ += word;
    } else if (type == "char" || type == "int8") {
      putAs<std::int8_t>(value);
    } else if (type == "uchar" || type == "uint8") {
      putAs<std::uint8_t>(value);
    } else if (type == "short" || type == "int16") {
      putAs<std::int16_t>(value);
    } else if (type == "ushort" || type == "uint16") {
      putAs<std::uint16_t>(value);
    } else if (type == "int" || type == "int32") {
      putAs<std::int32_t>(value);
    } else if (type == "uint" || type == "uint32") {
      putAs<std::uint32_t>(value);
    } else if (type == "float" || type == "float32") {
      putAs<float>(value);
    } else {
      putAs<double>(value);
    }
    return *this;
  }
  PlyData& list(std::string_view count, std::string_view type, const std::vector<double>& values) {
    put(count, static_cast<double>(values.size()));
    for (const double value : values) put(type, value);
    return *this;
  }
  const std::string& bytes() const { return bytes_; }
  /// With a header, whose "FORMAT" is this one.
  std::string file(std::string header) const {
    header.replace(header.find("FORMAT"), 6, format_);
    return header + bytes_;
  }

 private:
  template <class T>
  void putAs(double value) {
    const auto number = static_cast<T>(value);
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    if (format_ == "binary_big_endian") std::reverse(raw, raw + sizeof number);
    bytes_.append(raw, sizeof number);
  }
  std::string format_, bytes_;
};

}  // namespace tessera::test
