// Which slangc is taken, and that a warm start runs no program at all.
#include <catch2/catch.hpp>

#include "fixture.h"
#include "host/kernels/slang-sources.h"

namespace tessera::test {
namespace fs = std::filesystem;

namespace {

/// A program named slangc in a folder of its own: logs a line a call, then runs `body`, in which REAL stands for the
/// true one.
fs::path makeSlangc(const Workshop& shop, const std::string& name, std::string body) {
  static const fs::path real = shop.open().slangc().path;
  if (const std::size_t at = body.find("REAL"); at != std::string::npos) body.replace(at, 4, real.string());
  const fs::path program = shop.folder.path() / name / "slangc";
  writeText(program,
            "#!/bin/sh\necho called >> '" + (shop.folder.path() / name / "log").string() + "'\n" + body + "\n");
  fs::permissions(program, fs::perms::owner_all);
  return program;
}

// Lets every word through but those of -fp-mode precise.
constexpr const char* kForgetful =
    "for w; do shift; case $w in -fp-mode|precise) ;; *) set -- \"$@\" \"$w\";; esac; done; exec REAL \"$@\"";

}  // namespace

TEST_CASE("SLANGC is honoured or refused with the reason") {
  const Workshop shop;
  const fs::path good = makeSlangc(shop, "good", "exec REAL \"$@\"");
  {
    const Environment slangc("SLANGC", good.string());
    KernelCache cache = shop.open();
    CHECK(cache.slangc().origin == "SLANGC");
    CHECK(cache.slangc().path == good);
    CHECK_FALSE(cache.slangc().version.empty());
    cache.get(scaleRequest());
    CHECK(cache.statistics().compiled == 1);
  }
  const auto refusal = [&](const std::string& value) {
    const Environment slangc("SLANGC", value);
    return lineOf(ExitCode::kUsage, [&] { shop.open().get(scaleRequest()); });
  };
  CHECK(contains(refusal("/no/such/slangc"), "SLANGC=/no/such/slangc"));
  CHECK(contains(refusal("no-such-slangc"), "no such program"));
  CHECK(contains(refusal(shop.folder.path().string()), "no such program"));
  CHECK(contains(refusal("/bin/true"), "cannot compile a small kernel"));
  writeText(shop.folder.path() / "text", "not a program");
  fs::permissions(shop.folder.path() / "text", fs::perms::owner_all);
  CHECK(contains(refusal((shop.folder.path() / "text").string()), "cannot be run"));
  CHECK(contains(refusal(makeSlangc(shop, "forgetful", kForgetful).string()), "without NoContraction"));
  CHECK(contains(refusal(makeSlangc(shop, "unoptimised",
                                    "echo \"error[E00100]: failed to load downstream compiler 'spirv-opt'\"; exit 255")
                             .string()),
                 "spirv-opt"));
}

TEST_CASE("The slangc in PATH is taken if it will do and passed over if not") {
  const Workshop shop;
  const fs::path good = makeSlangc(shop, "good", "exec REAL \"$@\""), bad = makeSlangc(shop, "bad", kForgetful);
  const Environment none("SLANGC", "");
  {
    const Environment path("PATH", good.parent_path().string() + ":/usr/bin:/bin");
    CHECK(shop.open().slangc().origin == "PATH");
    CHECK(shop.open().slangc().path == good);
  }
  const Environment path("PATH", bad.parent_path().string() + ":/usr/bin:/bin");
  try {
    CHECK(shop.open().slangc().origin == "tools");
  } catch (const Error& error) {  // ./dev fetches none where the user's own will do
    CHECK(contains(error.what(), "without NoContraction"));
    CHECK(contains(error.what(), "./dev build"));
  }
}

TEST_CASE("A warm start runs no slangc") {
  const Workshop shop;
  const fs::path slangc = makeSlangc(shop, "good", "exec REAL \"$@\""), log = slangc.parent_path() / "log";
  const Environment environment("SLANGC", slangc.string());
  shop.open().get(scaleRequest());
  CHECK(kernels::readText(log) == "called\ncalled\ncalled\n");  // the check, the version, the kernel
  CHECK(shop.open().get(scaleRequest()).entry == "scaleAll");
  CHECK(kernels::readText(log) == "called\ncalled\ncalled\n");
  // What is remembered holds for this very file only, and a memory that cannot be read is none.
  writeText(slangc, kernels::readText(slangc) + "# another one\n");
  shop.open().get(scaleRequest());
  CHECK(kernels::readText(log) == "called\ncalled\ncalled\ncalled\ncalled\n");
  writeText(shop.cache / "tools.json", "{ broken");
  shop.open().get(scaleRequest());
  CHECK(kernels::readText(log) == "called\ncalled\ncalled\ncalled\ncalled\ncalled\ncalled\n");
}

}  // namespace tessera::test
