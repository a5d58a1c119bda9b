// How far a rendered image is from right, as render measures and says it.
#pragma once

#include <tessera/rasterizer.h>

#include <string>

#include "host/measure/row.h"

namespace tessera::measure {

/// `asked` without its approximate values. Shading stays what it was, where it was such a value that brought it in.
Variant exactVariant(const Variant& asked, const Variant& resolved);

/// Sets run.difference: the image against the oracle under run.variant, and its colours against those of the same scene
/// on the same device under `asked` without its approximate values.
void measureAgainstOracle(Run& run, const Variant& asked, const Framebuffer& image, Rasterizer& rasterizer);

/// Pixels whose triangle is not the oracle's: by id, or where a commit keeps a colour in its place, by a colour that is
/// farther from the exact one than the commit's bound. Absent where neither is held.
Difference::Count wrongWinners(const Variant& resolved, const Difference& difference, const Framebuffer& expected,
                               const Framebuffer& image);

/// A line for each error that `run` has; "" where none was measured.
std::string errorSummary(const Run& run);

}  // namespace tessera::measure
