// Real meshes, read where Debian's libcgal-demo installs them: the counts are those of the files' headers.
#include <sys/stat.h>

#include <chrono>
#include <cstdlib>

#include "datasets/installed-mesh.h"
#include "fixture.h"

using namespace tessera;
using namespace tessera::test;

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

TEST_CASE("An installed mesh is an input by name") {
  const Scene scene = loadInput("mesh:ChineseDragon-10kv", 32, 16);
  CHECK(scene.name == "ChineseDragon-10kv");
  CHECK(scene.triangles.size() == 19994);
  CHECK((scene.width == 32 && scene.height == 16));
  const Files files;
  const std::string path = files.write("a.toml", "[[mesh]]\nsource = \"mesh:ChineseDragon-10kv\"\n");
  CHECK(loadInput(path, 32, 16).positions == scene.positions);
  // Unpacked again where it is older than the archive: a new package may have another mesh.
  const auto mesh = datasets::installedMesh("ChineseDragon-10kv");
  const auto older =
      std::filesystem::last_write_time("/usr/share/doc/libcgal-demo/data.tar.gz") - std::chrono::hours(1);
  std::filesystem::last_write_time(mesh, older);
  CHECK(datasets::installedMesh("ChineseDragon-10kv") == mesh);
  CHECK(std::filesystem::last_write_time(mesh) > older);
  CHECK(usageError([] { loadInput("mesh:none"); }).starts_with("mesh:none: no such mesh; "));
  CHECK(usageError([] { loadInput("mesh:../../x"); }).starts_with("mesh:../../x: not a name"));
  CHECK(usageError([] { loadInput("mesh:"); }).starts_with("mesh: of what name? There are 3torus, "));
}

TEST_CASE("What is no file in the place of an unpacked mesh is replaced") {
  const Files files;
  const std::string before = std::getenv("TESSERA_CACHE");  // tests/main.cpp sets it
  setenv("TESSERA_CACHE", files.path("cache").c_str(), 1);
  const std::size_t all = datasets::installedMeshes().size();
  const std::filesystem::path mesh = datasets::installedMesh("ChineseDragon-10kv"),
                              names = mesh.parent_path() / "names";
  for (const bool pipe : {false, true})
    for (const auto& path : {mesh, names}) {
      INFO(path << (pipe ? ", a pipe" : ", a folder"));
      std::filesystem::remove_all(path);
      // A pipe without a writer would be waited for.
      REQUIRE((pipe ? mkfifo(path.c_str(), 0600) : mkdir(path.c_str(), 0700)) == 0);
      CHECK(datasets::installedMeshes().size() == all);
      CHECK(loadInput("mesh:ChineseDragon-10kv", 32, 16).triangles.size() == 19994);
      CHECK(std::filesystem::is_regular_file(path));
    }
  setenv("TESSERA_CACHE", before.c_str(), 1);
}
