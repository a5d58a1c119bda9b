// Text for people: aligned tables and readable figures.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tessera::support {

/// Rows of cells, two blanks between the columns; the first row is a heading and gets a rule under it. Columns in which
/// every cell but the heading looks like a number are set to the right.
std::string table(const std::vector<std::vector<std::string>>& rows);

std::string grouped(std::uint64_t number);                 ///< 88,928
std::string grouped(std::optional<std::uint64_t> number);  ///< a dash where there is none
std::string milliseconds(double nanoseconds);              ///< "4.21", three significant figures or more
std::string byteSize(std::uint64_t bytes);                 ///< "128 MiB"

}  // namespace tessera::support
