// Two sweeps that were begun, or resumed, at once: the second leaves what the first has written as it is.
#include "experiments/harness/journal.h"

#include <tessera/error.h>

#include <array>
#include <catch2/catch.hpp>
#include <fstream>

#include "datasets/random.h"
#include "datasets/text.h"
#include "experiments/harness/folder.h"
#include "experiments/harness/rows.h"
#include "host/measure/row.h"
#include "host/support/files.h"
#include "tests/sweep/small-journal.h"

using namespace tessera;
using namespace tessera::harness;
using tessera::test::smallJournal;

TEST_CASE("A journal that another sweep has begun or added to stays as it is") {
  const support::TemporaryFolder desk(std::filesystem::temp_directory_path(), "tessera-journal");
  const auto& folder = desk.path();
  const Json head{{"kind", "head"},
                  {"schema_version", measure::kRowSchemaVersion},
                  {"sweep", {{"title", "T"}, {"question", "Q"}, {"sha256", "0"}}},
                  {"quick", false},
                  {"rounds", 1},
                  {"repeats", 1},
                  {"jobs", {"s@cpu"}},
                  {"cells", Json::array()}};
  Journal::create(folder, head);
  const std::string first = datasets::readFile(journalOf(folder));
  CHECK_THROWS_WITH(Journal::create(folder, head), Catch::Contains("another sweep has begun there meanwhile"));
  CHECK(datasets::readFile(journalOf(folder)) == first);
  const auto entries = std::filesystem::directory_iterator(folder);
  CHECK(std::distance(begin(entries), end(entries)) == 1);

  const std::size_t before = readJournal(folder).bytes;
  std::ofstream(journalOf(folder), std::ios::app)
      << R"({"kind":"session","session":0,"utc":"2026-11-23T12:00:00Z","load":[0,0,0],"jobs":{"s@cpu":null}})" << '\n';
  const std::string added = datasets::readFile(journalOf(folder));
  Journal journal(folder);
  CHECK_THROWS_WITH(journal.cut(before), Catch::Contains("another sweep has written to it meanwhile"));
  CHECK(datasets::readFile(journalOf(folder)) == added);
}

namespace {

void put(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
}

}  // namespace

TEST_CASE("What is wrong in a journal is said with its line and key") {
  const support::TemporaryFolder desk(std::filesystem::temp_directory_path(), "tessera-journal");
  const std::string whole = smallJournal();
  put(journalOf(desk.path()), whole);
  REQUIRE_NOTHROW(rowsText(readJournal(desk.path())));
  for (const auto& [part, other, message] : std::vector<std::array<std::string, 3>>{
           {"\"round\":0", "\"round\":2", ":4: no line of a sweep's journal: round: is 2; a whole number up to 1"},
           {"\"round\":0", "\"round\":-1", ":4: no line of a sweep's journal: round: is -1"},
           {"\"total_ns\":5", "\"total_ns\":\"5\"", ":4: no line of a sweep's journal: total_ns: is \"5\""},
           {"\"total_ns\":5", "\"total_ns\":1e999", ":4: no line of a sweep's journal: is not JSON"},
           {"\"frame_s\":0.5,", "", ":3: no line of a sweep's journal: frame_s: is missing"},
           {"\"status\":\"ok\"", "\"status\":\"fine\"", ":3: no line of a sweep's journal: status: is \"fine\""},
           {"\"provenance\":{", "\"provenances\":{", ":3: no line of a sweep's journal: provenance: is missing"},
           {"\"id_mismatch\":null", "\"id_mismatch\":[]",
            ":3: no line of a sweep's journal: error.id_mismatch: is a list"},
           {"\"twin\":false", "\"twin\":0", ":1: no line of a sweep's journal: cells.0.sweep.twin: is 0"},
           {"\"id_mismatch\":null", "\"id_mismatch\":-3",
            ":3: no line of a sweep's journal: error.id_mismatch: is -3; a number from 0 would be right"},
           {"\"id_mismatch\":null", "\"id_mismatch\":65",
            ":3: no line of a sweep's journal: error.id_mismatch: is 65; a count of up to 64 pixels would be right"},
           {"\"variant\":{\"tile\":\"8\"", "\"variant\":{\"tile\":\"64\"",
            ":3: no line of a sweep's journal: variant.tile: is \"64\"; \"8\", as the head has asked, would be right"},
           {"\"variant\":{\"tile\":\"8\"", "\"variant\":{\"tile\":\"7\"",
            ":3: no line of a sweep's journal: variant.tile: "},
           {"\"size\":[8,8]", "\"size\":[9,8]", ":3: no line of a sweep's journal: scene.size: is a list; [8, 8]"},
           {"tessera render m.obj", "rm -rf /", ":1: no line of a sweep's journal: cells.0.command: is \"rm -rf"},
           {"render m.obj", "render $(touch x)", ":1: no line of a sweep's journal: cells.0.command: "},
           {"render m.obj", "render m.obj;reboot", ":1: no line of a sweep's journal: cells.0.command: "},
           {"--set tile=8", "--set tile=16", ":1: no line of a sweep's journal: cells.0.command: "},
           {"--repeat 2", "--repeat 3", ":1: no line of a sweep's journal: cells.0.command: "},
           {"--repeat 2", "--range 0,1;id --repeat 2", ":1: no line of a sweep's journal: cells.0.command: "},
           {"\"utc\":\"2026-11-23T12:00:00Z\"", "\"utc\":3", ":2: no line of a sweep's journal: utc: is 3; text"},
           {"T12:00:00Z", " noon", ":2: no line of a sweep's journal: utc: is \"2026-11-23 noon\"; text such as"},
           {"\"load\":[0.5,", "\"load\":[", ":2: no line of a sweep's journal: load: is a list; a list of three"},
           {"\"load\":[0.5,0.5,0.5]", "\"load\":\"x\"", ":2: no line of a sweep's journal: load: is \"x\""},
           {"\"jobs\":{\"s@cpu\":{\"cpu\":\"c\"}}", "\"jobs\":{}",
            ":2: no line of a sweep's journal: jobs: is an object; an object with each job"},
           {"\"jobs\":{\"s@cpu\"", "\"jobs\":{\"t@cpu\"", ":2: no line of a sweep's journal: jobs.t@cpu: "},
           {"\"stages\":{\"setup\":5}", "\"stages\":{}", ":4: no line of a sweep's journal: stages: is an object"},
           {"\"stages\":{\"setup\":5}", "\"stages\":{\"foo\":1}", ":4: no line of a sweep's journal: stages.foo: "},
           {"\"total_ns\":5", "\"total_ns\":0", ":4: no line of a sweep's journal: total_ns: is 0; 5 or more"},
           {"\"total_ns\":5", "\"total_ns\":5.5", ":4: no line of a sweep's journal: total_ns: is 5.5; a whole"},
           {"\"cpu\":\"c\",", "\"cpu\":" + std::string(99, '[') + std::string(99, ']') + ",",
            ":3: no line of a sweep's journal: nested"}}) {
    std::string text = whole;
    text.replace(text.find(part), part.size(), other);
    put(journalOf(desk.path()), text);
    CHECK_THROWS_WITH(readJournal(desk.path()), Catch::Contains(message));
  }
}

TEST_CASE("Rows that the journal beside them has lost stay as they are") {
  const support::TemporaryFolder desk(std::filesystem::temp_directory_path(), "tessera-journal");
  const std::string whole = smallJournal(), samplesGone = whole.substr(0, whole.rfind('\n', whole.size() - 2) + 1);
  put(journalOf(desk.path()), whole);
  deriveRows(desk.path());
  const std::string rows = datasets::readFile(desk.path() / "rows.jsonl");
  for (const auto& text : {samplesGone, whole.substr(0, whole.find('\n') + 1)}) {
    put(journalOf(desk.path()), text);
    CHECK_THROWS_WITH(deriveRows(desk.path()), Catch::Contains("rows.jsonl:1: "));
    CHECK_THROWS_WITH(recordOf(desk.path(), true), Catch::Contains("rows.jsonl:1: "));
    CHECK(datasets::readFile(desk.path() / "rows.jsonl") == rows);
  }
}

TEST_CASE("Damaged journals are read or refused and never more") {
  const support::TemporaryFolder desk(std::filesystem::temp_directory_path(), "tessera-journal");
  const std::string whole = smallJournal();
  constexpr std::uint64_t kSeed = 14;
  INFO("seed " << kSeed);
  datasets::Random random(kSeed);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random.bits() % n); };
  const std::array words{"null", "-1",   "1e400", "\"x\"", "[]", "{}", "true", "18446744073709551615",
                         "0.5",  "\x01", "\xff",  "\n",    "}",  "\""};
  std::size_t refused = 0;
  for (int run = 0; run < 2000; ++run) {
    std::string text = whole;
    for (std::size_t change = 0; change <= below(3); ++change) {
      const std::size_t at = below(text.size());
      switch (below(5)) {
        case 0:
          text[at] = static_cast<char>(random.bits());
          break;
        case 1:
          text.erase(at, 1 + below(20));
          break;
        case 2:
          text.insert(at, words[below(words.size())]);
          break;
        case 3: {  // a value for another
          const std::size_t colon = text.find(':', at);
          if (colon != std::string::npos)
            text.replace(colon + 1, text.find_first_of(",}", colon) - colon - 1, words[below(words.size())]);
          break;
        }
        default:
          text.resize(at + 1);
      }
    }
    put(journalOf(desk.path()), text);
    try {
      rowsText(readJournal(desk.path()));
    } catch (const Error& error) {
      ++refused;
      CHECK(error.code() == ExitCode::kUsage);
    }
  }
  CHECK(refused > 500);
}
