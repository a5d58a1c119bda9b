// experiments/report/tessera_report/row.schema.json, built in: what the report would refuse in a row is refused before
// it is written.
#pragma once

#include <string>

#include "experiments/harness/request.h"

namespace tessera::harness {

/// Holds `value` against a part of the schema: "" is a row, "/$defs/time" or "/properties/sweep" less. Throws
/// WrongField, with the field's name behind `key`, for what the schema refuses.
void checkSchema(const Json& value, const std::string& part, const std::string& key);

}  // namespace tessera::harness
