// Two sweeps that were begun, or resumed, at once: the second leaves what the first has written as it is.
#include "experiments/harness/journal.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "datasets/text.h"
#include "host/error.h"
#include "host/files.h"
#include "host/row.h"

using namespace tessera;
using namespace tessera::harness;

TEST_CASE("A journal that another sweep has begun or added to stays as it is") {
  const TemporaryFolder desk(std::filesystem::temp_directory_path(), "tessera-journal");
  const auto& folder = desk.path();
  const Json head{{"kind", "head"}, {"schema_version", kRowSchemaVersion}, {"cells", Json::array()}};
  Journal::create(folder, head);
  const std::string first = readFile(journalOf(folder));
  CHECK_THROWS_WITH(Journal::create(folder, head), Catch::Contains("another sweep has begun there meanwhile"));
  CHECK(readFile(journalOf(folder)) == first);
  const auto entries = std::filesystem::directory_iterator(folder);
  CHECK(std::distance(begin(entries), end(entries)) == 1);

  const std::size_t before = readJournal(folder).bytes;
  std::ofstream(journalOf(folder), std::ios::app) << R"({"kind":"session","session":0})" << '\n';
  const std::string added = readFile(journalOf(folder));
  Journal journal(folder);
  CHECK_THROWS_WITH(journal.cut(before), Catch::Contains("another sweep has written to it meanwhile"));
  CHECK(readFile(journalOf(folder)) == added);
}
