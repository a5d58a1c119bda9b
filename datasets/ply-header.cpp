#include "datasets/ply-header.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "datasets/text.h"

namespace tessera::datasets {
namespace {

const std::map<std::string_view, PlyType>& types() {
  using enum PlyType;
  static const std::map<std::string_view, PlyType> all{
      {"char", kInt8},   {"int8", kInt8},     {"uchar", kUint8},   {"uint8", kUint8},
      {"short", kInt16}, {"int16", kInt16},   {"ushort", kUint16}, {"uint16", kUint16},
      {"int", kInt32},   {"int32", kInt32},   {"uint", kUint32},   {"uint32", kUint32},
      {"float", kFloat}, {"float32", kFloat}, {"double", kDouble}, {"float64", kDouble}};
  return all;
}

class HeaderReader {
 public:
  explicit HeaderReader(const FileText& file) : in_(file, Scanner::Syntax::kPlain), file_(file) {}

  PlyHeader read() {
    if (!in_.line() || in_.word() != "ply" || in_.more()) in_.fail("'ply' would be right as the first line");
    const char* const end = file_.text.data() + in_.at();
    onlyReturns_ = in_.left() > 0 && *end == '\r' && (in_.left() == 1 || end[1] != '\n');
    bool hasFormat = false;
    for (;;) {
      if (!in_.line()) in_.fail("the file ends before end_header");
      const std::string_view word = in_.word();
      if (word == "comment" || word == "obj_info") continue;
      if (word == "end_header") break;
      if (word == "format") {
        if (std::exchange(hasFormat, true)) in_.fail("a second format");
        readFormat();
      } else if (word == "element") {
        readElement();
      } else if (word == "property") {
        readProperty();
      } else {
        in_.fail(fmt::format("{} where format, element, property, comment, obj_info or end_header would be right",
                             shown(word)));
      }
      endLine();
    }
    endLine();
    if (!hasFormat) in_.fail("no format; 'format ascii 1.0' or a binary one would be right");
    check();
    header_.bytes = in_.at() + lineEnd();
    return std::move(header_);
  }

 private:
  void endLine() {
    if (in_.more()) in_.fail(fmt::format("{} where the line's end would be right", shown(in_.word())));
  }
  /// Bytes of the line's end here. Binary data may begin with a line feed: it belongs to a carriage return before it
  /// unless the first line, too, ends in a carriage return alone.
  std::size_t lineEnd() const {
    const std::string_view left = file_.text.substr(in_.at(), 2);
    return left == "\r\n" && !onlyReturns_ ? 2 : std::min<std::size_t>(left.size(), 1);
  }

  void readFormat() {
    const std::string_view format = in_.wordInLine("the format"), version = in_.wordInLine("the version");
    const bool little = format == "binary_little_endian", big = format == "binary_big_endian";
    if ((format != "ascii" && !little && !big) || version != "1.0")
      in_.fail("format ascii, binary_little_endian or binary_big_endian, and 1.0, would be right");
    header_.format = little ? PlyHeader::Format::kLittleEndian
                     : big  ? PlyHeader::Format::kBigEndian
                            : PlyHeader::Format::kText;
  }
  void readElement() {
    PlyElement element;
    element.name = in_.wordInLine("the element's name");
    if (header_.find(element.name)) in_.fail(fmt::format("element {} is there twice", shown(element.name)));
    if (!in_.more()) in_.fail("count of the element is missing");
    element.count = static_cast<std::uint64_t>(in_.integer("count of the element", 0));
    header_.elements.push_back(std::move(element));
  }
  PlyType readType() {
    const std::string_view word = in_.wordInLine("the property's type");
    const auto found = types().find(word);
    if (found == types().end()) in_.fail(fmt::format("{} is not a type of PLY", shown(word)));
    return found->second;
  }
  void readProperty() {
    if (header_.elements.empty()) in_.fail("a property before the first element");
    PlyElement& element = header_.elements.back();
    PlyProperty property{};
    const std::size_t before = in_.at();
    if (in_.wordInLine("the property's type") == "list")
      property.count = readType();
    else
      in_.moveTo(before);
    property.type = readType();
    property.name = in_.wordInLine("the property's name");
    const std::string name = shown(property.name);
    if (element.find(property.name)) in_.fail(fmt::format("property {} is there twice", name));
    const bool corners = (property.name == "vertex_indices" || property.name == "vertex_index") &&
                         (element.name == "face" || element.name == "tristrips");
    if (corners && !property.count) in_.fail(fmt::format("{} is not a list", name));
    if (corners &&
        std::ranges::any_of(element.properties, [&](const PlyProperty& p) { return isCornerList(element, p); }))
      in_.fail("two lists of corners");
    if (element.name == "vertex" && property.count && (name == "'x'" || name == "'y'" || name == "'z'"))
      in_.fail(fmt::format("{} of a vertex is a list; one number would be right", name));
    element.properties.push_back(std::move(property));
  }
  void check() {
    const PlyElement* const vertices = header_.find("vertex");
    if (!vertices) in_.fail("no element 'vertex'");
    for (const char* const axis : {"x", "y", "z"})
      if (vertices->count > 0 && !vertices->find(axis))
        in_.fail(fmt::format("element 'vertex' has no property '{}'", axis));
    for (const PlyElement& element : header_.elements)
      if ((element.name == "face" || element.name == "tristrips") && element.count > 0 &&
          std::ranges::none_of(element.properties, [&](const PlyProperty& p) { return isCornerList(element, p); }))
        in_.fail(fmt::format("element '{}' has no list 'vertex_indices'", element.name));
  }

  Scanner in_;
  const FileText& file_;
  PlyHeader header_;
  bool onlyReturns_ = false;  ///< lines end in a carriage return alone
};

}  // namespace

std::size_t bytesOf(PlyType type) {
  constexpr std::size_t kBytes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

bool isInteger(PlyType type) { return type != PlyType::kFloat && type != PlyType::kDouble; }

std::string_view nameOf(PlyType type) {
  constexpr std::string_view kNames[] = {"char", "uchar", "short", "ushort", "int", "uint", "float", "double"};
  return kNames[static_cast<std::size_t>(type)];
}

bool isCornerList(const PlyElement& element, const PlyProperty& property) {
  return (element.name == "face" || element.name == "tristrips") && property.count &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

const PlyProperty* PlyElement::find(std::string_view property) const {
  const auto found = std::ranges::find(properties, property, &PlyProperty::name);
  return found == properties.end() ? nullptr : &*found;
}

bool PlyElement::hasLists() const {
  return std::ranges::any_of(properties, [](const PlyProperty& p) { return p.count.has_value(); });
}

std::size_t PlyElement::leastBytes() const {
  std::size_t bytes = 0;
  for (const PlyProperty& p : properties) bytes += bytesOf(p.count.value_or(p.type));
  return bytes;
}

const PlyElement* PlyHeader::find(std::string_view element) const {
  const auto found = std::ranges::find(elements, element, &PlyElement::name);
  return found == elements.end() ? nullptr : &*found;
}

PlyHeader readPlyHeader(const FileText& file) { return HeaderReader(file).read(); }

}  // namespace tessera::datasets
