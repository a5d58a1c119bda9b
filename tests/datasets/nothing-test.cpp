// Inputs that show nothing say so; the camera looks at what can be seen.
#include <cmath>

#include "fixture.h"

using namespace tessera;
using namespace tessera::test;

namespace {

const std::string kPlyHead = "ply\nformat ascii 1.0\n";
const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";

/// The notes of an input, without its path.
std::vector<std::string> notesOf(const std::string& path) {
  std::vector<std::string> notes = loadInput(path).notes;
  for (std::string& note : notes) {
    REQUIRE(note.starts_with(path));
    CHECK(note.find('\n') == std::string::npos);
    note = note.substr(path.size());
  }
  return notes;
}

using Notes = std::vector<std::string>;

}  // namespace

TEST_CASE("A mesh without a triangle that can be seen says so") {
  const Files files;
  CHECK(notesOf(files.write("a.off", "OFF\n0 0 0\n")) == Notes{": no vertices and no triangles"});
  CHECK(notesOf(files.write("b.off", "OFF\n2 0 0\n0 0 0\n1 0 0\n")) == Notes{": no triangles: 2 points only"});
  CHECK(notesOf(files.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n")) == Notes{": no triangles: 3 points only"});
  CHECK(notesOf(files.write("a.ply", kPlyHead + "element vertex 2\n" + kXyz + "end_header\n0 0 0\n1 1 1\n")) ==
        Notes{": no triangles: 2 points only"});
  CHECK(
      notesOf(files.write("c.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n3 9 1 2\n")) ==
      Notes{
          ": none of its 2 triangles can be drawn: each has an index out of range or a coordinate that is not finite"});
  CHECK(notesOf(files.write("d.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n3 1 1 1\n")) ==
        Notes{": none of its 2 triangles has an area"});
  CHECK(notesOf(files.write("good.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")).empty());
  // Some that cannot be drawn, beside one that can; in OBJ indices begin at 1.
  const Notes two{": 2 of 3 triangles have an index out of range and are not drawn"};
  CHECK(notesOf(files.write("e.off", "OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 3\n3 -1 1 2\n")) == two);
  CHECK(notesOf(files.write("e.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 0 1 2\nf 1 2 4\n")) == two);
  // In a scene, beside a mesh that shows something.
  CHECK(notesOf(files.write("a.toml", "[[mesh]]\nsource = \"good.off\"\n[[mesh]]\nsource = \"b.off\"\n")) ==
        Notes{": b.off: no triangles: 2 points only"});
}

TEST_CASE("A camera that sees nothing says where everything lies") {
  const Files files;
  const auto look = [&](const std::string& camera) {
    return notesOf(files.write("a.toml", "[[mesh]]\nsource = \"generate:icosphere?level=1\"\n[camera]\n" + camera));
  };
  const std::string nothing = ": the camera sees nothing: all triangles lie ";
  CHECK(look("eye = [0,0,5]\ntarget = [0,0,0]\n").empty());
  CHECK(look("eye = [0,0,5]\ntarget = [0,0,6]\n") == Notes{nothing + "behind the eye"});
  CHECK(look("eye = [0,0,500]\ntarget = [0,0,0]\n") == Notes{nothing + "beyond the far plane"});
  CHECK(look("eye = [0,0,5]\ntarget = [0,0,0]\nnear = 7\n") == Notes{nothing + "in front of the near plane"});
  CHECK(look("eye = [0,0,5]\ntarget = [5,0,0]\nfov = 30\n") == Notes{nothing + "left of the picture"});
  CHECK(look("eye = [0,0,5]\ntarget = [0,-5,0]\nfov = 30\n") == Notes{nothing + "above the picture"});
}

TEST_CASE("The automatic camera looks at the vertices that faces use") {
  const Files files;
  const std::string good = "0 0 0\n1 0 0\n0 1 0\n";
  const Matrix expected = loadInput(files.write("a.off", "OFF\n3 1 0\n" + good + "3 0 1 2\n")).clipFromObject;
  const auto camera = [&](const std::string& name, const std::string& text) {
    return loadInput(files.write(name, text)).clipFromObject;
  };
  // A vertex of no face, of a face with an index out of range, and of a face with a coordinate that is not finite.
  CHECK(camera("b.off", "OFF\n4 1 0\n" + good + "1e6 1e6 1e6\n3 0 1 2\n") == expected);
  CHECK(camera("c.off", "OFF\n4 2 0\n" + good + "1e6 0 0\n3 0 1 2\n3 0 3 99\n") == expected);
  CHECK(camera("a.obj", "v 0 0 0\nv 9e9 0 0\nv 1 0 0\nv 0 1 0\nf 1 3 4\n") == expected);
  CHECK(camera("a.toml", "[[mesh]]\nsource = \"b.off\"\n") != Matrix{});
  CHECK(loadInput(files.write("b.toml", "[[mesh]]\nsource = \"b.off\"\n")).clipFromObject == expected);
  // Far away unused vertices do not choose the origin either.
  CHECK(loadInput(files.path("b.off")).origin == glm::dvec3(0));
}

TEST_CASE("The automatic camera has numbers wherever float32 has coordinates") {
  const Files files;
  const Scene scene = loadInput(files.write("a.off", "OFF\n3 1 0\n-3e38 0 0\n3e38 0 0\n0 3e38 0\n3 0 1 2\n"));
  const Matrix& m = scene.clipFromObject;
  for (const glm::vec3& p : scene.positions)
    for (std::size_t row = 0; row < 16; row += 4)
      CHECK(std::isfinite(((m[row] * p.x + m[row + 1] * p.y) + m[row + 2] * p.z) + m[row + 3]));
  CHECK(scene.notes.empty());
}
