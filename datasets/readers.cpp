#include <fmt/format.h>

#include <OpenMesh/Core/IO/IOManager.hh>
#include <algorithm>
#include <cctype>
#include <iostream>
#include <mutex>
#include <sstream>

#include "datasets/attribute.h"
#include "datasets/checked.h"
#include "datasets/input.h"
#include "datasets/normals.h"
#include "datasets/plain-importer.h"
#include "datasets/stl.h"
#include "datasets/text.h"
#include "host/error.h"

namespace tessera {
namespace {

/// Takes what OpenMesh writes to std::cerr and std::clog, so that a failure is one line of ours.
class CapturedErrors {
 public:
  CapturedErrors() : cerr_(std::cerr.rdbuf(text_.rdbuf())), clog_(std::clog.rdbuf(text_.rdbuf())) {}
  ~CapturedErrors() {
    std::cerr.rdbuf(cerr_);
    std::clog.rdbuf(clog_);
  }
  std::string line() const {
    std::string all = text_.str();
    while (!all.empty() && std::isspace(static_cast<unsigned char>(all.back()))) all.pop_back();
    std::ranges::replace(all, '\n', ' ');
    return all.substr(0, 300);
  }

 private:
  std::ostringstream text_;
  std::streambuf *cerr_, *clog_;
};

std::string placeOf(std::string_view text, std::istream& in, bool binary, const PlainImporter& importer) {
  in.exceptions(std::ios::goodbit);
  in.clear();
  const auto at = static_cast<std::size_t>(std::max<std::streamoff>(in.tellg(), 0));
  if (binary)
    return fmt::format(": byte {}, after {} vertices and {} faces", at, importer.n_vertices(), importer.n_faces());
  return fmt::format(":{}", 1 + std::ranges::count(text.substr(0, at), '\n'));
}

Mesh readByOpenMesh(const std::string& name, const std::string& extension, const Checked& checked, bool binary) {
  // OpenMesh's readers are single objects with state, and what they print goes to one std::cerr.
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  PlainImporter importer(checked);
  std::istringstream in(checked.text);
  // They take no notice of a number that cannot be read, or of the end of the file. (OBJ is read by lines, up to a
  // failed one.)
  if (extension != "obj") in.exceptions(std::ios::failbit | std::ios::badbit);
  OpenMesh::IO::Options options(OpenMesh::IO::Options::VertexNormal);
  bool read = false;
  CapturedErrors errors;
  try {
    read = OpenMesh::IO::IOManager().read(in, extension, importer, options);
  } catch (const std::ios_base::failure&) {
    const bool atEnd = in.eof();
    failUsage(fmt::format("{}{}: {}", name, placeOf(checked.text, in, binary, importer),
                          atEnd ? "the file ends early" : "a number would be right"));
  }
  if (!read)
    failUsage(fmt::format("{}: cannot be read: {}", name, errors.line().empty() ? "not a mesh" : errors.line()));
  Mesh mesh = importer.take();
  if (importer.n_vertices() != checked.vertices || importer.n_faces() != checked.faces)
    failUsage(fmt::format("{}: holds {} vertices and {} faces, of which {} and {} can be read", name, checked.vertices,
                          checked.faces, importer.n_vertices(), importer.n_faces()));
  if (extension == "ply" && checked.wholeText) {
    in.exceptions(std::ios::goodbit);
    in.clear();
    // One line feed is ours; a file may end in one more or in none.
    const std::size_t left = checked.text.size() - static_cast<std::size_t>(in.tellg());
    if (binary ? left != 1 : checked.text.find_first_not_of(" \t\r\n", checked.text.size() - left) != std::string::npos)
      failUsage(fmt::format("{}: {} bytes are left after the last face: a count or a type of its header is wrong", name,
                            left - 1));
  }
  return mesh;
}

}  // namespace

Mesh readMesh(const std::filesystem::path& path, const AttributeRequest& attribute) {
  const std::string name = path.string();
  const std::string extension = lowerCase(path.extension().string());
  const bool obj = extension == ".obj", off = extension == ".off", ply = extension == ".ply", stl = extension == ".stl";
  if (!obj && !off && !ply && !stl)
    failUsage(fmt::format("{}: unknown extension '{}'; .obj, .off, .ply or .stl would be right", name, extension));
  const bool property = !attribute.name.empty() && !attribute.isCoordinate();
  if (property && !ply) failAttribute(name, attribute.name, kCoordinates);
  const std::string text = readFile(path);
  Mesh mesh;
  if (stl) {
    mesh = readStl(name, text);
  } else {
    const bool binary = ply && text.substr(0, 200).find("format binary") != std::string::npos;
    const Checked checked = obj ? checkObj(name, text) : off ? checkOff(name, text) : checkPly(name, text);
    mesh = readByOpenMesh(name, extension.substr(1), checked, binary);
    mesh.float32 = binary;  // OpenMesh gives float32 of each type
    if (property) mesh.attribute = readPlyScalar(name, text, checked, attribute);
  }
  completeNormals(mesh);
  return mesh;
}

}  // namespace tessera
