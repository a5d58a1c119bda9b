// A frame's times for people: stages, the frame's median, how far the frames were apart, and what that means.
#pragma once

#include <string>

#include "host/measure/row.h"

namespace tessera::cli {

/// Medians further off than this share are warned of: what people compare by eye differs by more than a twentieth.
inline constexpr double kWideSpread = 0.05;

/// A table of the stages and the frame, and a line with the frame's median, range and count.
std::string timesText(const measure::Run& run);
/// One line where the median may be off by more than kWideSpread; else "".
std::string timesWarning(const measure::Run& run);

}  // namespace tessera::cli
