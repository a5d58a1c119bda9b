// manifest.json: a host that knows nothing else runs the WGSL by it and gets the oracle's bits; its formulas are those
// of the frame that it holds.
#include <tessera/input.h>
#include <tessera/oracle.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <regex>

#include "fixture.h"
#include "host/oracle/oracle-image.h"
#include "host/support/subprocess.h"
#include "tests/cli/run-tessera.h"

using namespace tessera;
using namespace tessera::test;
using Json = nlohmann::json;

namespace {

template <typename T>
std::vector<T> wordsOf(const std::string& bytes) {
  std::vector<T> words(bytes.size() / sizeof(T));
  std::memcpy(words.data(), bytes.data(), words.size() * sizeof(T));
  return words;
}

/// + - * ( ) ceil(a / b), numbers and names.
class Formula {
 public:
  Formula(const std::string& text, const Json& names) : text_(text), names_(names) {}
  std::uint64_t value() {
    at_ = 0;
    const double result = sum();
    REQUIRE(at_ == text_.size());
    return static_cast<std::uint64_t>(result);
  }

 private:
  bool take(const std::string& sign) {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    if (text_.compare(at_, sign.size(), sign) != 0) return false;
    at_ += sign.size();
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    return true;
  }
  double sum() {
    double result = product();
    for (;;) {
      if (take("+"))
        result += product();
      else if (take("-"))
        result -= product();
      else
        return result;
    }
  }
  double product() {
    double result = factor();
    for (;;) {
      if (take("*"))
        result *= factor();
      else if (take("/"))
        result /= factor();
      else
        return result;
    }
  }
  double factor() {
    const bool up = take("ceil(");
    if (up || take("(")) {
      const double inner = sum();
      REQUIRE(take(")"));
      return up ? std::ceil(inner) : inner;
    }
    std::string word;
    while (at_ < text_.size() && std::isalnum(static_cast<unsigned char>(text_[at_]))) word += text_[at_++];
    REQUIRE(!word.empty());
    return std::isdigit(static_cast<unsigned char>(word[0])) ? std::stod(word) : names_.at(word).get<double>();
  }

  std::string text_;
  Json names_;
  std::size_t at_ = 0;
};

const Json& named(const Json& list, const std::string& key, const std::string& name) {
  for (const Json& item : list)
    if (item.at(key) == name) return item;
  FAIL("no " << name);
  return list;
}

/// Dispatch sizes and buffers are what the formulas say, with the uniforms of each dispatch.
void checkFormulas(const Json& manifest) {
  std::size_t dispatches = 0;
  for (const Json& command : manifest.at("commands")) {
    if (command.at("do") != "dispatch") continue;
    ++dispatches;
    const Json& stage = named(manifest.at("stages"), "stage", command.at("stage"));
    const Json& uniforms = command.at("uniforms");
    INFO(stage.at("stage"));
    const Json& groups = command.at("groups");
    CHECK(groups.at(0).get<std::uint64_t>() * groups.at(1).get<std::uint64_t>() ==
          Formula(stage.at("groups"), uniforms).value());
    for (const Json& field : stage.at("uniforms").at("fields"))
      CHECK(uniforms.contains(field.at("name").get<std::string>()));
    for (const Json& binding : stage.at("bindings")) {
      INFO(binding.dump());
      const std::string buffer = command.at("buffers").at(binding.at("name").get<std::string>());
      const std::uint64_t bytes = named(manifest.at("buffers"), "name", buffer).at("bytes");
      if (!binding.at("bytes").is_null()) CHECK(bytes >= Formula(binding.at("bytes"), uniforms).value());
      CHECK(binding.at("elementBytes").get<std::uint64_t>() > 0);
      if (binding.at("name") == "counters") CHECK(bytes == 8 * manifest.at("counters").size());
    }
  }
  CHECK(dispatches >= 4);
}

}  // namespace

TEST_CASE("A host that has the manifest alone runs the WGSL with the bits of the oracle") {
  const std::string input = "generate:soup?count=300&pixels=150";
  for (const std::string settings : {"shade=flat", "commit=two-pass binning=none"}) {
    Desk desk;
    const Variant variant(settings);
    const auto emitted = desk.tessera("kernels --emit wgsl out '" + input + "' --size 100x75 --set '" + settings + "'");
    INFO(settings << "\n" << emitted.err << emitted.out);
    REQUIRE(emitted.code == 0);
    const Json manifest = Json::parse(desk.read("out/manifest.json"));
    checkFormulas(manifest);
    for (const Json& stage : manifest.at("stages"))  // names are Slang's
      for (const Json& binding : stage.at("bindings")) CHECK(binding.at("inFile") == binding.at("name"));

    const support::ProcessResult ran = support::runProcess({TESSERA_RUN_WGSL, (desk.path() / "out").string()});
    INFO(ran.output);
    REQUIRE(ran.ok());
    const Framebuffer oracle = oracle::render(loadInput(input, 100, 75), oracle::imageAxesOf(variant)).image;
    CHECK(wordsOf<std::uint32_t>(desk.read("out/ids.out")) == oracle.ids);
    const auto depth = wordsOf<float>(desk.read("out/depth.out"));
    REQUIRE(depth.size() == oracle.depth.size());
    CHECK(std::memcmp(depth.data(), oracle.depth.data(), 4 * depth.size()) == 0);
  }
}
