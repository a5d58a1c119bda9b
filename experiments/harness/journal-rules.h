// What the lines of a journal have to say alike: the head's cells, the rows of their checks, the samples, the list of
// axes.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "experiments/harness/cells.h"
#include "experiments/harness/request.h"

namespace tessera::harness {

/// Holds each line against those before it. Everything here throws WrongField for what no sweep writes.
class JournalRules {
 public:
  /// A cell of the head: what it says of the sweep, and the command, which its settings give.
  void takeCell(const Json& cell, const Json& head, const std::string& place);
  void takeSession(const Json& line, const Json& head) const;
  /// A row as a check leaves it, with all that rows, summaries and a resumed sweep take from it.
  void takeRow(const Json& row, const Json& cell, const Json& head);
  /// Times and errors of a sample, beside the row of its cell.
  void checkSample(const Json& line, const Json& row) const;

 private:
  struct Place {
    std::string input, attribute, range;
    bool operator==(const Place&) const = default;
  };
  void checkCommand(const Json& cell, const Json& head, const std::string& place);
  void checkScene(const Json& scene, const Json& cell);

  std::map<std::string, Place> places_;                         ///< of scenes, by name, as commands have them
  std::map<std::size_t, Size> sizes_;                           ///< by cell
  std::map<std::pair<std::string, std::string>, Json> scenes_;  ///< as rows have them, by name and size
  std::map<std::string, Json> triangles_;                       ///< by a scene's hash
  Json truth_;                                                  ///< of all rows; null: no row yet
};

}  // namespace tessera::harness
