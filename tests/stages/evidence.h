// What shows that an axis value is at work: a counter, an image, a stage that ran, or a refusal.
#pragma once

#include <functional>
#include <string>

namespace tessera {

/// Checks that run frames with it. Of an axis of integers the values are "least" and "most". The test fails where there
/// is none: a new axis or value has to bring its own.
const std::function<void()>& evidence(const std::string& axis, const std::string& value);

}  // namespace tessera
