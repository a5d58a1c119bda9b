// Frames against the oracle, told in one line.
#pragma once

#include <tessera/framebuffer.h>
#include <tessera/oracle.h>
#include <tessera/rasterizer.h>

#include <string>

#include "host/oracle/oracle-image.h"

namespace tessera::test {

/// "" where every bit that both hold is equal; else how many pixels differ, and what the first one holds.
std::string difference(const Framebuffer& got, const Framebuffer& expected);
/// "" where each counter that the oracle has, too, is equal.
std::string difference(const Counters& got, const oracle::Counts& expected);
/// Image and counters.
std::string difference(const Frame& got, const oracle::Result& expected);
/// Of stage outputs: "" or the first stage, element and word that differ.
std::string difference(const std::vector<StageOutput>& got, const std::vector<StageOutput>& expected);

}  // namespace tessera::test
