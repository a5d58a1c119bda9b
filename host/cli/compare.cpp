// tessera compare: two .exr files, pixel by pixel, bit by bit or within tolerances.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "datasets/text.h"
#include "host/cli/commands.h"
#include "host/cli/common.h"
#include "host/cli/difference.h"
#include "host/images/comparison.h"
#include "host/measure/image-facts.h"
#include "host/support/files.h"
#include "host/support/table.h"
#include "host/support/terminal.h"
#include "host/support/text.h"

namespace tessera::cli {
namespace {

struct CompareOptions {
  std::string a, b, output, json, allow, maxUnpacked;
  std::vector<std::string> tolerances, limits;
  bool quiet = false;
};

/// What is held against each other, the options read.
struct Request {
  images::Tolerances within, limits;
  std::set<std::string> limited;  // channels that --at-most names, by 0, too
  std::uint64_t maxUnpacked = 0;  // bytes; 0: by the files' sizes
  double allowed = 0;             // pixels, or per cent of them
  bool perCent = false;

  double allowedOf(std::uint64_t pixels) const {
    return perCent ? allowed / 100 * static_cast<double>(pixels) : allowed;
  }
};

double numberOf(const std::string& text, const std::string& option, const std::string& example) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value >= 0) || !std::isfinite(value))
    failUsage(fmt::format("{}: not a number from 0 up; {} would be right", option, example));
  return value;
}

/// A size in bytes: "1000", "8G", "8 GiB". Units go by 1024.
std::uint64_t bytesOf(const std::string& text, const std::string& option) {
  constexpr std::string_view kUnits = "kmgtpe";
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  std::string unit = support::lowerCase({rest, end});
  unit.erase(0, unit.find_first_not_of(' '));
  unsigned shift = 0;
  if (const std::size_t at = unit.empty() ? kUnits.npos : kUnits.find(unit[0]); at != kUnits.npos) {
    shift = 10 * static_cast<unsigned>(at + 1);
    unit.erase(0, 1);
    if (unit == "ib") unit.clear();
  }
  const bool good = error == std::errc{} && (unit.empty() || unit == "b");
  if (!good || number == 0 || number > std::numeric_limits<std::uint64_t>::max() >> shift)
    failUsage(
        fmt::format("{} {}: not a size from 1 byte to 16 EiB; a whole number, alone or with K, M, G or T behind it, "
                    "would be right, as in 8G",
                    option, text));
  return number << shift;
}

images::Tolerances tolerancesOf(const std::vector<std::string>& texts, const std::string& option) {
  images::Tolerances result;
  std::set<std::pair<std::string, bool>> given;  // a channel, in steps or not
  for (const std::string& text : texts) {
    const std::string named = fmt::format("{} {}", option, text), channel = text.substr(0, text.find('='));
    images::Amount* const amount = channel == "depth"    ? &result.depth
                                   : channel == "values" ? &result.attribute
                                   : channel == "colour" ? &result.colour
                                                         : nullptr;
    if (!amount || channel.size() == text.size())
      failUsage(
          fmt::format("{}: takes depth=, values= or colour= and an amount, as in depth=1e-6 or colour=4ulp", named));
    std::string number = text.substr(channel.size() + 1);
    const bool steps = number.ends_with("ulp");
    if (steps) number.resize(number.size() - 3);
    if (!given.emplace(channel, steps).second)
      failUsage(fmt::format("{}: {} is given {} twice; once would be right", named, channel,
                            steps ? "in float32 steps" : "as a number"));
    const std::string right = channel + (steps ? "=4ulp" : "=1e-6");
    const double value = (steps ? amount->steps : amount->absolute) = numberOf(number, named, right);
    if (steps && value != std::floor(value))
      failUsage(fmt::format("{}: not a whole number of steps; {} would be right", named, right));
  }
  return result;
}

Request requestOf(const CompareOptions& options) {
  Request request;
  request.within = tolerancesOf(options.tolerances, "--tolerance");
  request.limits = tolerancesOf(options.limits, "--at-most");
  for (const std::string& text : options.limits) request.limited.insert(text.substr(0, text.find('=')));
  if (!options.maxUnpacked.empty()) request.maxUnpacked = bytesOf(options.maxUnpacked, "--max-unpacked");
  if (options.allow.empty()) return request;
  const std::string named = "--allow " + options.allow, right = "100 pixels or 0.1%";
  request.perCent = options.allow.ends_with('%');
  request.allowed = numberOf(options.allow.substr(0, options.allow.size() - request.perCent), named, right);
  if (request.perCent && request.allowed > 100)
    failUsage(fmt::format("{}: more than all pixels; {} would be right", named, right));
  if (!request.perCent && request.allowed != std::floor(request.allowed))
    failUsage(fmt::format("{}: not a whole number of pixels; {} would be right", named, right));
  return request;
}

/// A line for each channel that one of the two has and the other has not: it is not compared.
std::string missingText(const CompareOptions& options, const Framebuffer& a, const Framebuffer& b) {
  std::string text;
  const auto check = [&](const char* channel, bool inA, bool inB) {
    if (inA != inB) text += fmt::format("{}: only in {}, not compared\n", channel, inA ? options.a : options.b);
  };
  check("id and depth", !a.ids.empty(), !b.ids.empty());
  check("hits", !a.hits.empty(), !b.hits.empty());
  const bool alone = a.channels.size() == 1 && b.channels.size() == 1;  // compared, whatever their names
  std::set<std::string> names;
  for (const Framebuffer* frame : {&a, &b})
    for (const Channel& channel : frame->channels) names.insert(channel.name);
  const bool several = a.channels.size() > 1 || b.channels.size() > 1;
  for (const std::string& name : names)
    if (!alone)
      check((several ? "values " + name : std::string("values")).c_str(), a.channel(name) != nullptr,
            b.channel(name) != nullptr);
  check("colour", !a.colour.empty(), !b.colour.empty());
  return text;
}

/// What the two depend on that is not the same, by name.
using OtherFacts = std::map<std::string, std::array<std::optional<std::string>, 2>>;
OtherFacts otherFacts(const ImageFacts& a, const ImageFacts& b) {
  OtherFacts facts;
  for (const auto& [name, text] : a) facts[name][0] = text;
  for (const auto& [name, text] : b) facts[name][1] = text;
  std::erase_if(facts, [](const auto& fact) { return fact.second[0] == fact.second[1]; });
  return facts;
}

std::string factsText(const CompareOptions& options, const OtherFacts& facts) {
  std::string text;
  for (const auto& [name, values] : facts)
    text += fmt::format("{}: {} in {}, {} in {}\n", name, values[0].value_or("-"), options.a, values[1].value_or("-"),
                        options.b);
  return text;
}

/// The three that one reading fills.
struct Outcome {
  images::Comparison bits, within, limits;
  Framebuffer a, b;  // of the last rows, for what they hold
  OtherFacts facts;
};

struct Verdict {
  const char* word;
  ExitCode code;
};

Verdict verdictOf(const Request& request, const Outcome& outcome) {
  if (outcome.bits.difference().equal()) return {"equal", ExitCode::kDone};
  const Difference within = outcome.within.difference();
  const bool tooMany = static_cast<double>(within.anywhere) > request.allowedOf(within.pixels);
  // Beyond the limit for one channel says nothing of those without a limit.
  const Difference limits = outcome.limits.difference();
  const auto broken = [&](const char* channel, const Difference::Count& count) {
    return request.limited.contains(channel) && count.value_or(0);
  };
  const bool tooFar =
      broken("depth", limits.depth) || broken("values", limits.attribute) || broken("colour", limits.colour);
  if (tooMany || tooFar) return {"different", ExitCode::kDifference};
  return {"equal within the tolerances", ExitCode::kDone};
}

/// Reads both, and writes the picture of where they differ, a band of rows at a time.
Outcome compareFiles(const CompareOptions& options, const Request& request, std::optional<ImageOutput>& output) {
  ImageReader a(options.a, request.maxUnpacked), b(options.b, request.maxUnpacked);
  Outcome outcome{images::Comparison(),
                  images::Comparison(request.within),
                  images::Comparison(request.limits),
                  {},
                  {},
                  otherFacts(a.facts(), b.facts())};
  if (a.width() != b.width() || a.height() != b.height())
    failUsage(fmt::format("the images are {} x {} and {} x {} pixels; they should have one size", a.width(), a.height(),
                          b.width(), b.height()));
  const auto readRows = [&](std::uint32_t begin, std::uint32_t end) {
    a.read(begin, end, outcome.a);
    b.read(begin, end, outcome.b);
    for (images::Comparison* comparison : {&outcome.bits, &outcome.within, &outcome.limits})
      comparison->add(outcome.a, outcome.b);
  };
  if (output) {
    ImageFacts facts = measure::factsOf("where two images differ");
    std::ranges::set_intersection(a.facts(), b.facts(), std::inserter(facts, facts.begin()));
    std::ranges::sort(facts);
    facts.erase(std::ranges::unique(facts, {}, [](const auto& fact) { return fact.first; }).begin(), facts.end());
    output->write(
        a.width(), a.height(),
        [&](std::uint32_t begin, std::uint32_t end, glm::vec3* out) {
          readRows(begin, end);
          images::paintDifference(outcome.a, outcome.b, 0, end - begin, out, request.within);
        },
        facts);
    return outcome;
  }
  const std::uint32_t rows = std::min(a.bandRows(), b.bandRows());
  for (std::uint32_t begin = 0; begin < a.height(); begin += rows) readRows(begin, std::min(a.height(), begin + rows));
  return outcome;
}

std::string outcomeText(const CompareOptions& options, const Request& request, const Outcome& outcome) {
  const Difference bits = outcome.bits.difference(), within = outcome.within.difference();
  const Verdict verdict = verdictOf(request, outcome);
  std::string text = missingText(options, outcome.a, outcome.b) + factsText(options, outcome.facts);
  text += request.within.any() ? describe(bits, within) : describe(bits);
  if (!options.allow.empty())
    text += fmt::format("{} of {} pixels differ{}; {} may\n", support::grouped(within.anywhere),
                        support::grouped(within.pixels), request.within.any() ? " beyond the tolerances" : "",
                        options.allow);
  text += fmt::format("{}\n", verdict.word);
  if (!options.output.empty()) text += fmt::format("wrote {}\n", options.output);
  if (verdict.code == ExitCode::kDone) return text;
  // Of what counts: beyond the limits where nothing is beyond the tolerances.
  const images::Comparison& shown = within.equal() ? outcome.limits : outcome.within;
  return text + firstPixel(shown.difference(), {options.a, shown.firstOfA()}, {options.b, shown.firstOfB()}) + '\n';
}

std::string outcomeJson(const CompareOptions& options, const Request& request, const Outcome& outcome) {
  using Json = nlohmann::ordered_json;
  const auto json = [](const Difference& difference) {
    Json result = Json::parse(measure::differenceText(difference));
    const auto finite = [](const std::optional<double>& value) {
      return value && std::isfinite(*value) ? Json(*value) : Json();
    };
    result["attribute_max"] = finite(difference.attributeMax);
    result["attribute_rms"] = finite(difference.attributeRms);
    result["colour_max"] = finite(difference.colourMax);
    result["different_pixels"] = difference.anywhere;
    result["first"] = difference.equal() ? Json() : Json{difference.firstX, difference.firstY};
    return result;
  };
  const Verdict verdict = verdictOf(request, outcome);
  Json result = {{"a", options.a},
                 {"b", options.b},
                 {"verdict", verdict.word},
                 {"exit_code", static_cast<int>(verdict.code)},
                 {"bits", json(outcome.bits.difference())}};
  result["beyond_tolerance"] = request.within.any() ? json(outcome.within.difference()) : Json();
  result["beyond_limit"] = !request.limited.empty() ? json(outcome.limits.difference()) : Json();
  result["depends_on"] = Json::object();
  for (const auto& [name, values] : outcome.facts)
    for (const auto& value : values) result["depends_on"][name].push_back(value ? Json(*value) : Json());
  return support::visible(result.dump(-1, ' ', false, Json::error_handler_t::replace));
}

ExitCode runCompare(const CompareOptions& options) {
  const Request request = requestOf(options);
  std::optional<ImageOutput> output;
  std::vector<std::filesystem::path> outputs;
  if (!options.output.empty()) outputs.push_back(output.emplace(options.output).path());
  if (!options.json.empty()) outputs.emplace_back(options.json);
  support::checkApart(outputs, {options.a, options.b});
  std::optional<support::AppendedFile> rows;
  if (!options.json.empty()) rows.emplace(options.json);
  const Outcome outcome = compareFiles(options, request, output);
  if (rows) rows->append(outcomeJson(options, request, outcome));
  if (options.quiet) return verdictOf(request, outcome).code;
  const bool stdoutIsTaken = std::ranges::any_of(outputs, support::isStdout);
  support::say(stdoutIsTaken ? stderr : stdout, "{}", outcomeText(options, request, outcome));
  return verdictOf(request, outcome).code;
}

}  // namespace

Command addCompare(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  auto* const command =
      app.add_subcommand("compare", "compare two .exr images bit by bit in the channels that both have; exit code 5 when they differ");
  command->add_option("A", options->a, "an .exr that render wrote")->required();
  command->add_option("B", options->b, "another of the same size")->required();
  command
      ->add_option("-o,--output", options->output,
                   "a picture of where they differ; a pipe or - needs its format, as in png:-")
      ->type_name("IMAGE.png");
  command
      ->add_option(
          "--tolerance", options->tolerances,
          "agree where depth, values or colour (of R, G, B the one that differs most) are this near: a number, "
          "or float32 steps as in depth=2ulp; repeat for more")
      ->type_name("CHANNEL=AMOUNT")
      ->allow_extra_args(false);
  command
      ->add_option(
          "--allow", options->allow,
          "so many pixels may differ beyond the tolerances (in ids or coverage, too): 100, or a share as in 0.1%")
      ->type_name("N|P%");
  command
      ->add_option("--at-most", options->limits,
                   "but none of the pixels that --allow allows by more than this; as for --tolerance")
      ->type_name("CHANNEL=AMOUNT")
      ->allow_extra_args(false);
  command->add_option("--json", options->json, "add the counts, one line of JSON, to FILE's end; - is stdout")
      ->type_name("FILE");
  command
      ->add_option(
          "--max-unpacked", options->maxUnpacked,
          "read a file that unpacks to this size (as in 8G); if not given 512 MiB or 1100 times the file's size, "
          "the larger")
      ->type_name("SIZE");
  addQuiet(*command, options->quiet);
  command->footer(
      "Examples:\n"
      "  tessera render mesh:refined_elephant -o cpu.exr --set shade=flat\n"
      "  tessera render mesh:refined_elephant -o gpu.exr --set shade=flat --device vulkan\n"
      "  tessera compare cpu.exr gpu.exr -o difference.png\n"
      "  tessera compare cpu.exr gpu.exr --tolerance colour=0.004 --allow 0.1% --at-most colour=0.1 --json -");
  return {command, [options] { return runCompare(*options); }};
}

}  // namespace tessera::cli
