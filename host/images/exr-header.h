// What an .exr asks for, read before a library is let at it: OpenEXR takes the memory that a header names, true or not.
#pragma once

#include <cstdint>
#include <filesystem>

namespace tessera::images {

/// Refuses (kUsage, one line) what is not a single part of plain scanlines with a sane size, and what takes more than
/// `limit` bytes once unpacked. 0 is the default limit: 512 MiB, or 1100 times the file's own size where this is more,
/// as zip, with which images are written, packs 1032 bytes into one at best.
void checkExr(const std::filesystem::path& path, std::uint64_t limit = 0);

}  // namespace tessera::images
