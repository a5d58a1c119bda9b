#include "fixture.h"

using namespace tessera;
using namespace tessera::test;

TEST_CASE("OFF: polygons are fanned, duplicate and non-manifold faces stay in order") {
  const Files files;
  const Mesh mesh = readMesh(files.write("a.off", R"(OFF
# a comment
5 6 0

0 0 0
1 0 0   # and another
1 1 0
0 1 0
0.5 0.5 1
4 0 1 2 3
3 0 1 4
3 0 1 4
3 1 0 2
3 1 0 4
3 0 0 1
)"));
  CHECK(mesh.positions.size() == 5);
  CHECK(mesh.positions[4] == glm::dvec3(0.5, 0.5, 1));
  const std::vector<Triangle> expected{{0, 1, 2}, {0, 2, 3}, {0, 1, 4}, {0, 1, 4}, {1, 0, 2}, {1, 0, 4}, {0, 0, 1}};
  CHECK(mesh.triangles == expected);
}

TEST_CASE("OFF: colours and counts on the first line, Windows line ends, no line end at the end") {
  const Files files;
  const Mesh mesh = readMesh(files.write("a.off",
                                         "COFF 3 2 0\r\n0 0 0 1 2 3 4\r\n1 0 0 1 2 3 4\r\n0 1 0 1 2 3 4\r\n"
                                         "3 0 1 2 255 0 0\r\n3 2 1 0 9 9 9"));
  const std::vector<Triangle> expected{{0, 1, 2}, {2, 1, 0}};
  CHECK(mesh.triangles == expected);
}

TEST_CASE("OFF: an index out of range is kept as one that no joined mesh can reach") {
  const Files files;
  const std::string path = files.write("a.off", "OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n3 0 -1 2\n3 0 1 2\n");
  const Mesh mesh = readMesh(path);
  const std::vector<Triangle> expected{{0, 1, kBadIndex}, {0, kBadIndex, 2}, {0, 1, 2}};
  CHECK(mesh.triangles == expected);
  Scene scene;
  append(scene, mesh);
  append(scene, mesh);
  REQUIRE(scene.triangles.size() == 6);
  CHECK(scene.triangles[0] == expected[0]);
  CHECK(scene.triangles[3] == Triangle{3, 4, kBadIndex});
  CHECK(scene.triangles[5] == Triangle{3, 4, 5});
}

TEST_CASE("OFF: no faces make an empty mesh") {
  const Files files;
  CHECK(readMesh(files.write("a.off", "OFF\n0 0 0\n")).triangles.empty());
  CHECK(loadInput(files.write("b.off", "OFF\n0 0 0\n")).triangles.empty());
}

TEST_CASE("OFF: the header and the data need not stand one record a line") {
  const Files files;
  const std::vector<Triangle> expected{{0, 1, 2}, {0, 2, 3}};
  for (const std::string text : {
           "OFF4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n",
           "OFF 4 2\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n",
           "# first\n\n  OFF # here\n#\n4 2 # too\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n# last\n\n",
           "OFF 4 2 0 0 0 0 1 0 0 1 1 0 0 1 0 3 0 1 2 3 0 2 3",
           "OFF\n4\n2\n0\n0 0\n0 1 0 0 1 1\n0 0 1 0 3 0\n1 2 3 0 2\n3",
           "OFF\n4 2 0\n0 0 0 1 0 0\n1 1 0 0 1 0\n3 0 1 2 3 0 2 3\n",
           "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0\n 1 2\n3 0 2 3\n",
           "OFF\n4 2 0\n0 0 0 9 9 9\n1 0 0 9 9 9 9\n1 1 0\n0 1 0\n3 0 1 2 1 0 0\n3 0 2 3 7\n",
           "NOFF\n4 2 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n3 0 2 3 0.5 0.5 0.5 1\n",
       }) {
    INFO(text);
    const Mesh mesh = readMesh(files.write("a.off", text));
    CHECK(mesh.positions == std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    CHECK(mesh.triangles == expected);
  }
  std::string all = "STCNOFF 3 1 0";
  for (const char* const p : {"0 0 0", "1 0 0", "0 1 0"})
    all += std::string(" ") + p + " 0 0 1  0.5 0.5 0.5 1  0.25 0.75";
  CHECK(readMesh(files.write("b.off", all + " 3 0 1 2")).triangles == std::vector<Triangle>{{0, 1, 2}});
}

TEST_CASE("OFF: faces of fewer than three corners are counted, and counts must fit the data") {
  const Files files;
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  const Mesh mesh = readMesh(files.write("a.off", "OFF\n3 4 0\n" + points + "2 0 1\n3 0 1 2\n1 0\n0\n"));
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(mesh.notes == std::vector<std::string>{"3 faces have fewer than three corners and no triangle"});
  CHECK(readError(files, "a.off", "OFF\n3 1 0\n" + points + "3 0 1 2\n3 2 1 0\n")
            .starts_with("a.off:7: '3' after the last of 3 vertices and 1 faces: the counts are wrong"));
  CHECK(readError(files, "a.off", "OFF\n2 1 0\n" + points + "3 0 1 2\n").starts_with("a.off:"));
  CHECK(readError(files, "a.off", "OFF\n4 1 0\n" + points + "3 0 1 2\n").starts_with("a.off:"));
  CHECK(readError(files, "a.off", "OFF\n3 1 0\n" + points + "3 0 1 2 9 9\n")
            .starts_with("a.off:6: 2 numbers follow the face on its line"));
  CHECK(readError(files, "a.off", "OFF\n3 1 0\n" + points + "4 0 1 2\n") == "a.off:6: corner of a face is missing");
  CHECK(readError(files, "a.off", "4OFF\n3 1 0\n").starts_with("a.off:1: '4OFF': vertices of four or n coordinates"));
  CHECK(readError(files, "a.off", "nOFF 3\n3 1 0\n").starts_with("a.off:1: 'nOFF': vertices of four or n coordinates"));
  CHECK(readError(files, "a.off", "OFFx 3 1 0\n").starts_with("a.off:1: 'OFFx' where OFF"));
  CHECK(readError(files, "a.off", "off 3 1 0\n").starts_with("a.off:1: 'off' where OFF"));
}

TEST_CASE("OFF: broken files are refused where they are broken") {
  const Files files;
  const std::string three = "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n";
  CHECK(readError(files, "a.off", "") == "a.off: is empty");
  CHECK(readError(files, "a.off", "3 1 0\n").starts_with("a.off:1: '3' where OFF"));
  CHECK(readError(files, "a.off", "OFF\n").starts_with("a.off:1: the file ends before the counts"));
  CHECK(readError(files, "a.off", "OFF BINARY\n3 2 0\n").starts_with("a.off:1: binary OFF is not read"));
  CHECK(readError(files, "a.off", "OFF\n4000000000 1 0\n").starts_with("a.off:2: count of vertices: '4000000000'"));
  CHECK(readError(files, "a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n") == "a.off:4: the file ends after 2 of 3 vertices");
  CHECK(readError(files, "a.off", three + "3 0 1 2\n") == "a.off:6: the file ends after 1 of 2 faces");
  CHECK(readError(files, "a.off", three + "3 0 1 2\n3 0 1\n") == "a.off:7: corner of a face is missing");
  CHECK(readError(files, "a.off", three + "3 0 1 2\n-1 0 1\n").starts_with("a.off:7: count of corners: '-1'"));
  CHECK(readError(files, "a.off", three + "3 0 1 2.5\n").starts_with("a.off:6: corner of a face: '2.5'"));
  CHECK(readError(files, "a.off", "OFF\n3 2 0\n0 0 0\nnan 0 0\n").starts_with("a.off:4: vertex (x y z): 'nan'"));
  CHECK(readError(files, "a.off", "OFF\n3 2 0\n0 0 0\n1e39 0 0\n").starts_with("a.off:4: vertex (x y z): '1e39'"));
  CHECK(readError(files, "a.off", "OFF\n3 2 0\n0 0\n").starts_with("a.off:3: vertex (x y z) is missing"));
}

TEST_CASE("Files that are no meshes are refused") {
  const Files files;
  CHECK(usageError([&] { readMesh(files.path("none.off")); }) == files.path("none.off") + ": no such file");
  std::filesystem::create_directory(files.path("folder.off"));
  CHECK(usageError([&] { readMesh(files.path("folder.off")); }).find("is a folder") != std::string::npos);
  CHECK(readError(files, "a.xyz", "0 0 0\n") ==
        "a.xyz: unknown extension '.xyz'; .obj, .off, .ply or .stl would be right");
  CHECK(readError(files, "a", "0 0 0\n").find("unknown extension ''") != std::string::npos);
  // Extensions in capitals are the same ones.
  CHECK(readMesh(files.write("A.OFF", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")).triangles.size() == 1);
}
