// Drivers that do not load: the message names the variable, its value and the cause, and never blames memory.
#include <tessera/error.h>
#include <tessera/vulkan-device.h>

#include <catch2/catch.hpp>
#include <cstdlib>

#include "tests/cli/run-tessera.h"

using namespace tessera::test;

namespace {

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// `variable` as the shell sets it, and what the message has to say about it beside the whole assignment.
struct Fault {
  std::string variable, cause;
};

std::string icd(const std::string& library) {
  return R"({"file_format_version": "1.0.0", "ICD": {"library_path": ")" + library + R"(", "api_version": "1.2.0"}})";
}

}  // namespace

TEST_CASE("A driver that the environment hides or breaks is named with its variable") {
  Desk desk;
  desk.write("two.obj", twoTriangles());
  desk.write("broken.json", "{ no JSON");
  desk.write("empty.json", "");
  desk.write("no-icd.json", R"({"file_format_version": "1.0.0"})");
  desk.write("no-library.json", icd("/nonexistent/libdriver.so"));
  desk.write("no-elf.so", "a text");
  desk.write("no-elf.json", icd("./no-elf.so"));
  desk.write("no-driver.json", icd("libz.so.1"));
  const std::string here = desk.path().string() + "/";
  const std::vector<Fault> faults{
      {"VK_ICD_FILENAMES=/nonexistent", "no such file"},
      {"VK_ICD_FILENAMES=", "VK_ICD_FILENAMES= (empty)"},
      {"VK_DRIVER_FILES=/nonexistent/a.json:/nonexistent/b.json", "/nonexistent/b.json)"},
      {"VK_LOADER_DRIVERS_SELECT=nosuch*", "no Vulkan driver"},
      {"VK_LOADER_DRIVERS_DISABLE=*", "no Vulkan driver"},
      {"VK_ICD_FILENAMES=" + here + "broken.json", "broken.json: not a valid JSON file"},
      {"VK_ADD_DRIVER_FILES=" + here + "broken.json", "broken.json: not a valid JSON file"},
      {"VK_ICD_FILENAMES=" + here + "empty.json", "no Vulkan driver"},
      {"VK_ICD_FILENAMES=" + here + "no-icd.json", "no-icd.json"},
      {"VK_DRIVER_FILES=" + here + "no-library.json", "/nonexistent/libdriver.so: cannot open"},
      {"VK_ICD_FILENAMES=" + here + "no-elf.json", "no-elf.so: "},
      {"VK_ICD_FILENAMES=" + here + "no-driver.json", "libz.so.1"}};
  for (const auto& [variable, cause] : faults) {
    const auto rendered = desk.tessera("render two.obj -o a.png --size 16x16 --device vulkan", variable);
    INFO(variable << "\n" << rendered.err);
    CHECK(rendered.code == 2);
    CHECK(rendered.complainsOnce());
    CHECK(contains(rendered.err, variable));
    CHECK(contains(rendered.err, cause));
    CHECK_FALSE(contains(rendered.err, "emory"));
  }
  // The commands that look for devices themselves go on with the CPU, and say as much.
  for (const std::size_t i : {std::size_t{0}, std::size_t{5}}) {
    const auto& [variable, cause] = faults[i];
    const auto devices = desk.tessera("devices", variable);
    INFO(variable << "\n" << devices.out << devices.err);
    CHECK(devices.code == 0);
    CHECK(contains(devices.out, variable));
    CHECK(contains(devices.out, cause));
    const auto parity = desk.tessera("parity two.obj --size 16x16", variable);
    INFO(parity.err);
    CHECK(parity.code == 0);
    CHECK(contains(parity.err, variable));
    CHECK(contains(parity.err, cause));
    CHECK(contains(parity.err, "the CPU alone is compared"));
  }
}

TEST_CASE("A file that is not there is said beside the drivers that are") {
  Desk desk;
  const auto outcome = desk.tessera("render generate:grid -o a.png --size 16x16 --device vulkan:mine",
                                    "VK_ADD_DRIVER_FILES=/nonexistent/mine.json");
  INFO(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "llvmpipe"));
  CHECK(contains(outcome.err, "VK_ADD_DRIVER_FILES=/nonexistent/mine.json (no such file)"));
}

TEST_CASE("What tessera sets itself is not held against the user") {
  Desk desk;
  const auto outcome =
      desk.tessera("render generate:grid -o a.png --size 16x16 --device vulkan", "VK_LOADER_DRIVERS_SELECT=nosuch");
  CHECK(outcome.code == 2);
  CHECK_FALSE(contains(outcome.err, "VK_ADD_DRIVER_FILES"));
  CHECK_FALSE(contains(desk.tessera("render generate:grid -o a.png --device vulkan:mine").err, "VK_ADD_DRIVER_FILES"));
}

TEST_CASE("A hidden validation layer is named with its variable") {
  setenv("VK_LAYER_PATH", "/nonexistent", 1);
  try {
    tessera::VulkanOptions options;
    options.validation = true;
    tessera::makeVulkanDevice(options);
    FAIL("a layer from nowhere");
  } catch (const tessera::Error& error) {
    CHECK(error.code() == tessera::ExitCode::kUsage);
    CHECK(contains(error.what(), "VK_LAYER_PATH=/nonexistent (no such file)"));
  }
  unsetenv("VK_LAYER_PATH");
}
