// tessera compare: two .exr files, pixel by pixel, bit by bit.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>

#include "host/cli/commands.h"
#include "host/cli/common.h"
#include "host/cli/difference.h"
#include "host/files.h"
#include "host/terminal.h"

namespace tessera::cli {
namespace {

struct CompareOptions {
  std::string a, b, output;
};

/// A line for each channel that one of the two has and the other has not: it is not compared.
std::string missingText(const CompareOptions& options, const Framebuffer& a, const Framebuffer& b) {
  std::string text;
  const auto check = [&](const char* channel, bool inA, bool inB) {
    if (inA != inB) text += fmt::format("{}: only in {}, not compared\n", channel, inA ? options.a : options.b);
  };
  check("id and depth", !a.ids.empty(), !b.ids.empty());
  check("hits", !a.hits.empty(), !b.hits.empty());
  check("values", !a.attribute.empty(), !b.attribute.empty());
  check("colour", !a.colour.empty(), !b.colour.empty());
  return text;
}

ExitCode runCompare(const CompareOptions& options) {
  std::optional<ImageOutput> output;
  if (!options.output.empty()) {
    output.emplace(options.output);
    checkApart({output->path()}, {options.a, options.b});
  }
  const Framebuffer a = readImage(options.a);
  const Framebuffer b = readImage(options.b);
  const Difference difference = compare(a, b);
  if (output) {
    Framebuffer picture{
        .width = a.width, .height = a.height, .depth = {}, .ids = {}, .hits = {}, .colour = differencePicture(a, b)};
    output->write(picture);
  }
  say(stdout, "{}{}", missingText(options, a, b), describe(difference));
  if (!options.output.empty()) say(stdout, "wrote {}\n", options.output);
  if (difference.equal()) return ExitCode::kDone;
  say(stdout, "{}\n", firstPixel(difference, {options.a, a}, {options.b, b}));
  return ExitCode::kDifference;
}

}  // namespace

Command addCompare(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  auto* const command =
      app.add_subcommand("compare", "compare two .exr images bit by bit in the channels that both have; exit code 5 when they differ");
  command->add_option("A", options->a, "an .exr that render wrote")->required();
  command->add_option("B", options->b, "another of the same size")->required();
  command->add_option("-o,--output", options->output, "a picture of where they differ")->type_name("FILE.png");
  command->footer("Example:\n  tessera compare cpu.exr gpu.exr -o difference.png");
  return {command, [options] { return runCompare(*options); }};
}

}  // namespace tessera::cli
