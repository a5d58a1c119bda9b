// The numbers behind the header of a PLY file, one after another: as words, or as bytes of either order. Both classes
// have the same members, so that one walk reads all three formats.
#pragma once

#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "datasets/ply-header.h"
#include "datasets/text.h"

namespace tessera::datasets {

/// What is being read, for messages.
struct PlyPlace {
  const PlyElement* element = nullptr;
  const PlyProperty* property = nullptr;
  std::uint64_t row = 0;

  std::string text() const {
    return property ? fmt::format("{} of {} {}", property->name, element->name, row) : element->name;
  }
};

/// Calls `visit` with a zero of the type.
template <class Visit>
auto withPlyType(PlyType type, Visit visit) {
  switch (type) {
    case PlyType::kInt8:
      return visit(std::int8_t{});
    case PlyType::kUint8:
      return visit(std::uint8_t{});
    case PlyType::kInt16:
      return visit(std::int16_t{});
    case PlyType::kUint16:
      return visit(std::uint16_t{});
    case PlyType::kInt32:
      return visit(std::int32_t{});
    case PlyType::kUint32:
      return visit(std::uint32_t{});
    case PlyType::kFloat:
      return visit(float{});
    default:
      return visit(double{});
  }
}

class PlyText {
 public:
  PlyText(const FileText& file, const PlyHeader& header, const PlyPlace& place)
      : in_(file, Scanner::Syntax::kPlain), place_(place) {
    in_.moveTo(header.bytes);
  }
  /// Refuses a count of things, of at least so many numbers each, that cannot all be there. Bounds what is set aside.
  void need(std::uint64_t count, std::size_t numbers, std::size_t /*bytes*/) {
    if (numbers != 0 && count > (in_.left() + 1) / (2 * numbers)) failEnd();
  }
  double take(PlyType type) {
    if (!in_.ahead()) failEnd();
    const std::string_view what = place_.property->name;
    if (type == PlyType::kDouble) return in_.number(what);
    if (type == PlyType::kFloat) return static_cast<double>(in_.single(what));
    return static_cast<double>(withPlyType(type, [&](auto zero) {
      using T = decltype(zero);
      if constexpr (std::is_integral_v<T>)
        return in_.integer(what, std::numeric_limits<T>::min(), std::numeric_limits<T>::max());
      return std::int64_t{0};
    }));
  }
  template <class Take>
  void takeAll(PlyType type, std::uint64_t count, Take each) {
    for (std::uint64_t i = 0; i < count; ++i) each(take(type));
  }
  void skip(PlyType type, std::uint64_t count) {
    takeAll(type, count, [](double) {});
  }
  [[noreturn]] void fail(std::string_view wrong) { in_.fail(fmt::format("{}: {}", place_.text(), wrong)); }
  void finish() {
    if (!in_.ahead()) return;
    const std::string_view word = in_.word();
    in_.fail(fmt::format("{} is left after the last element: a count of the header is wrong", shown(word)));
  }

 private:
  [[noreturn]] void failEnd() {
    while (in_.ahead()) in_.word();
    in_.fail(fmt::format("the file ends early, in {}", place_.text()));
  }
  Scanner in_;
  const PlyPlace& place_;
};

template <bool kBigEndian>
class PlyBytes {
 public:
  PlyBytes(const FileText& file, const PlyHeader& header, const PlyPlace& place)
      : file_(file), at_(file.text.data() + header.bytes), end_(file.text.data() + file.text.size()), place_(place) {}

  template <class T>
  static T load(const char* at) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), at, sizeof(T));
    if constexpr (kBigEndian) std::ranges::reverse(bytes);
    return std::bit_cast<T>(bytes);
  }
  void need(std::uint64_t count, std::size_t /*numbers*/, std::size_t bytes) {
    if (bytes != 0 && count > static_cast<std::uint64_t>(end_ - at_) / bytes) failEnd();
  }
  double take(PlyType type) {
    double value = 0;
    takeAll(type, 1, [&](double taken) { value = taken; });
    return value;
  }
  template <class Take>
  void takeAll(PlyType type, std::uint64_t count, Take each) {
    need(count, 1, bytesOf(type));
    withPlyType(type, [&](auto zero) {
      using T = decltype(zero);
      for (std::uint64_t i = 0; i < count; ++i, at_ += sizeof(T)) each(static_cast<double>(load<T>(at_)));
    });
    if (at_ >= report_) report();
  }
  /// Bytes that need() has seen.
  const char* takeBytes(std::size_t count) {
    if (at_ >= report_) report();
    return std::exchange(at_, at_ + count);
  }
  /// Takes as many of the next lists as are triangles of the types that most files have; gives their count.
  std::uint64_t takeTriangles(const PlyProperty& list, std::uint64_t most, std::uint64_t vertices,
                              std::vector<std::array<std::uint32_t, 3>>& triangles) {
    using Corners = std::array<std::uint32_t, 3>;
    constexpr std::size_t kBytes = 1 + sizeof(Corners);
    if (bytesOf(*list.count) != 1 || !isInteger(list.type) || bytesOf(list.type) != 4) return 0;
    const char* const begin = at_;
    const char* const end = at_ + std::min(most, static_cast<std::uint64_t>(end_ - at_) / kBytes) * kBytes;
    for (; at_ != end && *at_ == 3; at_ += kBytes) {
      Corners& corners = triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const auto v = load<std::uint32_t>(at_ + 1 + 4 * k);  // a negative one is beyond all vertices, too
        corners[k] = v < vertices ? v : kBadIndex;
      }
    }
    if (at_ >= report_) report();
    return static_cast<std::uint64_t>(at_ - begin) / kBytes;
  }
  void skip(PlyType type, std::uint64_t count) {
    need(count, 1, bytesOf(type));
    at_ += count * bytesOf(type);
  }
  [[noreturn]] void fail(std::string_view wrong) { failAt(fmt::format("{}: {}", place_.text(), wrong)); }
  void finish() {
    if (at_ != end_)
      failAt(fmt::format("{} bytes are left after the last element: a count or a type of the header is wrong",
                         end_ - at_));
  }

 private:
  void report() {
    constexpr std::ptrdiff_t kEvery = 1 << 22;
    const char* const begin = file_.text.data();
    if (file_.progress) file_.progress(static_cast<std::size_t>(at_ - begin), file_.text.size());
    report_ = at_ + std::min(kEvery, end_ - at_);
  }
  [[noreturn]] void failEnd() { failAt(fmt::format("the file ends early, in {}", place_.text())); }
  [[noreturn]] void failAt(const std::string& wrong) {
    failUsage(fmt::format("{}: byte {}: {}", file_.name, at_ - file_.text.data(), wrong));
  }
  const FileText& file_;
  const char *at_, *end_, *report_ = at_;
  const PlyPlace& place_;
};

}  // namespace tessera::datasets
