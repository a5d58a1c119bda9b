// What shows that an axis value is at work: a counter, an image, a stage that ran, or a refusal.
#pragma once

#include <functional>
#include <map>
#include <string>

namespace tessera::test {

/// By axis, by value.
using Evidence = std::map<std::string, std::map<std::string, std::function<void()>>>;

/// Checks that run frames with it. Of an axis of integers the values are "least" and "most". The test fails where there
/// is none: a new axis or value has to bring its own.
const std::function<void()>& evidence(const std::string& axis, const std::string& value);

/// Of the axes that raster and later stages read; evidence.cpp has the others.
const Evidence& rasterEvidence();

}  // namespace tessera::test
