#include "tests/sweep/small-journal.h"

#include "experiments/harness/journal.h"
#include "host/measure/row.h"

namespace tessera::test {

using harness::Json, harness::lineOf;

std::string smallJournal() {
  const Json sweep{{"title", "T"}, {"question", "Q"}, {"sha256", std::string(64, '0')}};
  Json cell{
      {"cell", 0},
      {"name", "n"},
      {"command", "tessera render m.obj --size 8x8 --device cpu --threads 1 --set tile=8 --repeat 2 --error --json -"},
      {"sweep", sweep}};
  cell["sweep"].update({{"cell", 0},
                        {"group", 0},
                        {"reference", true},
                        {"twin", false},
                        {"asked", {{"tile", "8"}}},
                        {"swept", {"tile"}},
                        {"scene", "s"},
                        {"device", "cpu"},
                        {"threads", 1}});
  const Json row{{"schema_version", measure::kRowSchemaVersion},
                 {"run_id", "r"},
                 {"variant", {{"tile", "8"}}},
                 {"scene", {{"name", "s"}, {"size", {8, 8}}}},
                 {"status", "ok"},
                 {"error", {{"id_mismatch", nullptr}}},
                 {"provenance", {{"cpu", "c"}, {"kernels", {{"setup", "h"}}}}},
                 {"clock", "wall"}};
  return lineOf({{"kind", "head"},
                 {"schema_version", measure::kRowSchemaVersion},
                 {"sweep", sweep},
                 {"quick", false},
                 {"rounds", 2},
                 {"repeats", 1},
                 {"jobs", {"s@cpu"}},
                 {"cells", Json::array({cell})}}) +
         lineOf({{"kind", "session"},
                 {"session", 0},
                 {"utc", "2026-11-23T12:00:00Z"},
                 {"load", {0.5, 0.5, 0.5}},
                 {"jobs", {{"s@cpu", {{"cpu", "c"}}}}}}) +
         lineOf({{"kind", "cell"}, {"cell", 0}, {"session", 0}, {"frame_s", 0.5}, {"row", row}}) +
         lineOf({{"kind", "sample"},
                 {"cell", 0},
                 {"round", 0},
                 {"repeat", 0},
                 {"session", 0},
                 {"total_ns", 5},
                 {"stages", {{"setup", 5}}}});
}

}  // namespace tessera::test
