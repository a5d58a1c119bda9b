#include "run-tessera.h"

#include <fmt/format.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace tessera::test {
namespace {

namespace fs = std::filesystem;

fs::path makeFolder() {
  std::string pattern = (fs::temp_directory_path() / "tessera-cli-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder can be made");
  return pattern;
}

std::string readAll(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

bool Outcome::complainsOnce() const {
  static const std::regex progress(R"([a-z ]+ \d+/\d+[^\n]*, \d+ s(, about \d+ s left)?\n)");
  const std::string said = std::regex_replace(err, progress, "");
  return said.starts_with("tessera: ") && said.size() > 10 && std::count(said.begin(), said.end(), '\n') == 1 &&
         said.back() == '\n';
}

Desk::Desk() : path_(makeFolder()), streams_(makeFolder()) {}

Desk::~Desk() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  fs::remove_all(streams_, ignored);
}

void Desk::write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
}

std::string Desk::read(const std::string& name) const { return readAll(path_ / name); }

std::vector<std::string> Desk::names() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

Outcome Desk::tessera(const std::string& arguments, const std::string& before) const {
  const fs::path out = streams_ / "out", err = streams_ / "err";
  const std::string command = fmt::format("cd '{}' && {} '{}' {} </dev/null >'{}' 2>'{}'", path_.string(), before,
                                          TESSERA_PROGRAM, arguments, out.string(), err.string());
  const int status = std::system(command.c_str());
  return {.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1, .out = readAll(out), .err = readAll(err)};
}

void checkRefused(const Desk& desk, const std::string& arguments, const std::string& named) {
  const auto before = desk.names();
  const auto outcome = desk.tessera(arguments);
  INFO("tessera " << arguments << "\n" << outcome.err << outcome.out);
  CHECK(outcome.code == 2);
  CHECK(outcome.complainsOnce());
  CHECK(outcome.err.find(named) != std::string::npos);
  CHECK(desk.names() == before);
}

std::string twoTriangles() {
  return "v -1 -1 0\nv 1 -1 0\nv 0 1 0\n"
         "v -1 -1 0.5\nv 1 -1 0.5\nv 0 0.5 0.5\n"
         "f 1 2 3\nf 4 5 6\n";
}

}  // namespace tessera::test
