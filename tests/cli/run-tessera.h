// The program as a user runs it: a shell, a folder of one's own, an exit code and two streams.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tessera::test {

struct Outcome {
  int code = -1;
  std::string out, err;

  /// Exactly one line on stderr, which starts with the program's name; but for progress, which a slow machine shows.
  bool complainsOnce() const;
};

/// An empty folder, removed at the end. Commands run in it.
class Desk {
 public:
  Desk();
  ~Desk();
  Desk(const Desk&) = delete;

  const std::filesystem::path& path() const { return path_; }
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  /// Names of all that lies in it, hidden files too, sorted.
  std::vector<std::string> names() const;
  /// `arguments` as typed after the program's name; `before` goes ahead of it (environment).
  Outcome tessera(const std::string& arguments, const std::string& before = "") const;

 private:
  std::filesystem::path path_, streams_;
};

/// Runs and checks: exit code 2, one line that names `named`, no file made or lost.
void checkRefused(const Desk& desk, const std::string& arguments, const std::string& named);

/// Two triangles of which the nearer one hides a part of the other, as an .obj file.
std::string twoTriangles();

}  // namespace tessera::test
