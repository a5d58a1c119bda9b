// What goes wrong with sources, compilers and folders: one line that says where and what.
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "fixture.h"

namespace tessera::test {
namespace fs = std::filesystem;

TEST_CASE("A Slang error comes with its place and message and the variant") {
  const Workshop shop;
  writeText(shop.slang / "step-size.slang", "module step_size;\n\npublic float step() { return zork; }\n");
  for (const Route route : {Route::kCpp, Route::kSpirv, Route::kGlsl}) {
    const std::string line = lineOf(ExitCode::kFailure, [&] { shop.open().get(scaleRequest(route)); });
    CHECK(contains(line, "kernel scale"));
    CHECK(contains(line, "[step=1]"));
    CHECK(contains(line, "step-size.slang:3"));
    CHECK(contains(line, "zork"));
  }
  CHECK(countFiles(shop.cache, ".tmp") == 0);
  CHECK(countFiles(shop.cache, "interface.json") == 0);
}

TEST_CASE("A C++ error comes with the compiler's message") {
  const Workshop shop;
  writeText(shop.slang / "machine/atomics-cpp.h", "int tesseraBroken() { return undeclaredThing; }\n");
  const std::string line = lineOf(ExitCode::kFailure, [&] { shop.open().get(scaleRequest()); });
  CHECK(contains(line, "[step=1]"));
  CHECK(contains(line, "kernel.cpp:1"));
  CHECK(contains(line, "undeclaredThing"));
}

TEST_CASE("Missing sources are named") {
  const Workshop shop;
  KernelRequest request = scaleRequest();
  request.source = "stages/none.slang";
  CHECK(contains(lineOf(ExitCode::kUsage, [&] { shop.open().get(request); }), "stages/none.slang"));
  CHECK(contains(lineOf(ExitCode::kUsage,
                        [&] {
                          KernelCache({shop.cache, shop.slang / "no-such-folder", false, ""});
                        }),
                 "no-such-folder"));
}

TEST_CASE("A cache folder that cannot be written is one clear line") {
  const Workshop shop;
  writeText(shop.folder.path() / "file", "not a folder");
  const std::string line = lineOf(ExitCode::kUsage, [&] {
    KernelCache({shop.folder.path() / "file" / "cache", shop.slang, false, ""}).get(scaleRequest());
  });
  CHECK(contains(line, "file/cache"));
  CHECK(contains(line, "TESSERA_CACHE"));
}

TEST_CASE("What is no file in the place of a cached file is cleared away") {
  const Workshop shop;
  const std::filesystem::path binary = shop.open().get(scaleRequest(Route::kSpirv)).binary,
                              entry = binary.parent_path();
  const auto heals = [&](const std::filesystem::path& path, bool file) {
    INFO(path);
    std::filesystem::remove_all(path);
    if (file)
      writeText(path, "no folder");
    else
      std::filesystem::create_directories(path / "folder");
    CHECK(shop.open().get(scaleRequest(Route::kSpirv)).binary == binary);
    KernelCache again = shop.open();
    again.get(scaleRequest(Route::kSpirv));
    CHECK(again.statistics().hits == 1);
  };
  heals(binary, false);
  heals(entry / "interface.json", false);
  heals(entry, true);
  heals(shop.cache / "tools.json", false);
  CHECK(std::filesystem::is_regular_file(shop.cache / "tools.json"));
  // A pipe without a writer would be waited for, and a device has no end.
  for (const std::filesystem::path& path : {binary, entry / "interface.json", shop.cache / "tools.json"}) {
    INFO(path);
    std::filesystem::remove_all(path);
    REQUIRE(mkfifo(path.c_str(), 0600) == 0);
    CHECK(shop.open().get(scaleRequest(Route::kSpirv)).binary == binary);
    if (path.filename() == "tools.json") continue;  // written when something is asked
    CHECK(std::filesystem::is_regular_file(path));
    std::filesystem::remove(path);
    std::filesystem::create_symlink("/dev/null", path);
    CHECK_THROWS_AS(shop.open().get(scaleRequest(Route::kSpirv)), Error);  // others can write it
    std::filesystem::remove(path);
  }
}

TEST_CASE("A cache that others can write is refused") {
  const Workshop shop;
  const std::filesystem::path binary = shop.open().get(scaleRequest(Route::kSpirv)).binary;
  for (const std::filesystem::path& path :
       {binary, binary.parent_path(), binary.parent_path() / "interface.json", shop.cache, shop.cache / "tools.json"}) {
    const auto before = std::filesystem::status(path).permissions();
    for (const auto others : {std::filesystem::perms::group_write, std::filesystem::perms::others_write}) {
      std::filesystem::permissions(path, before | others);
      const std::string line = lineOf(ExitCode::kUsage, [&] { shop.open().get(scaleRequest(Route::kSpirv)); });
      CHECK(contains(line, path.string() + ": others can write it"));
    }
    std::filesystem::permissions(path, before);
  }
  CHECK(shop.open().get(scaleRequest(Route::kSpirv)).binary == binary);
  if (geteuid() != 0 || chown(binary.c_str(), 12345, 12345) != 0) return;  // root alone gives files away
  CHECK(contains(lineOf(ExitCode::kUsage, [&] { shop.open().get(scaleRequest(Route::kSpirv)); }), "belongs to 12345"));
}

TEST_CASE("What others may not write is made so under whatever umask") {
  const Workshop shop;
  const mode_t before = umask(0);
  const std::filesystem::path cache = shop.folder.path() / "deep" / "cache";
  const auto get = [&] { return KernelCache({cache, shop.slang, false, ""}).get(scaleRequest()); };
  const CompiledKernel made = get();
  umask(before);
  CHECK(get().binary == made.binary);
}

TEST_CASE("A file that slangc reads unknown to the key is refused") {
  const Workshop shop;
  writeText(shop.slang / "hidden.slang", "module hidden;\npublic float more() { return 1.0; }\n");
  writeText(shop.slang / "step-size.slang",
            "module step_size;\nimport\n  hidden;\npublic float step() { return more(); }\n");
  const std::string line = lineOf(ExitCode::kFailure, [&] { shop.open().get(scaleRequest()); });
  CHECK(contains(line, "hidden.slang"));
  CHECK(contains(line, "no import names it"));
}

TEST_CASE("A kernel whose SPIR-V is not exact is refused on both Vulkan routes") {
  const Workshop shop;
  writeText(shop.slang / "step-size.slang",
            "module step_size;\nimport variant;\npublic float step() { return lerp(1.0, values[0], values[1]); "
            "}\nStructuredBuffer<float> values;\n");
  for (const Route route : {Route::kSpirv, Route::kGlsl}) {
    const std::string line = lineOf(ExitCode::kFailure, [&] { shop.open().get(scaleRequest(route)); });
    CHECK(contains(line, "not exact"));
    CHECK(contains(line, "FMix"));
  }
}

TEST_CASE("A resource that no host can bind is refused") {
  const Workshop shop;
  writeText(shop.slang / "step-size.slang",
            "module step_size;\nByteAddressBuffer raw;\npublic float step() { return asfloat(raw.Load(0)); }\n");
  for (const Route route : {Route::kCpp, Route::kSpirv})
    CHECK(contains(lineOf(ExitCode::kFailure, [&] { shop.open().get(scaleRequest(route)); }), "`raw`"));
}

}  // namespace tessera::test
