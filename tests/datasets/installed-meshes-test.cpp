// Real meshes, read where Debian's libcgal-demo installs them: the counts are those of the files' headers.
#include <cstdlib>

#include "fixture.h"

using namespace tessera;

TEST_CASE("Real meshes are read whole") {
  const Files files;
  const std::string command = "tar -xzf /usr/share/doc/libcgal-demo/data.tar.gz -C '" + files.path("") +
                              "' data/meshes/refined_elephant.off data/meshes/bunny00.off data/meshes/armadillo.off"
                              " data/meshes/ChineseDragon-10kv.off data/meshes/sphere.stl data/meshes/sphere.ply";
  REQUIRE(std::system(command.c_str()) == 0);
  struct Expected {
    const char* name;
    std::size_t vertices, triangles;
  };
  for (const auto& [name, vertices, triangles] : {Expected{"refined_elephant.off", 44460, 88928},
                                                  {"bunny00.off", 37706, 75408},
                                                  {"armadillo.off", 26002, 52000},
                                                  {"ChineseDragon-10kv.off", 10000, 19994},
                                                  {"sphere.stl", 162, 320},
                                                  {"sphere.ply", 162, 320}}) {
    INFO(name);
    const Mesh mesh = readMesh(files.path(std::string("data/meshes/") + name));
    CHECK(mesh.positions.size() == vertices);
    CHECK(mesh.triangles.size() == triangles);
    CHECK(mesh.normals.size() == vertices);
  }
}
