// What the device must know of a SPIR-V module before it creates a pipeline from it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tessera::devices::vulkan {

struct SpirvModule {
  std::vector<std::uint32_t> words;         ///< without OpSource
  std::string entry;                        ///< name of its one compute entry point (slangc calls it "main")
  std::vector<std::uint32_t> capabilities;  ///< SPIR-V capability numbers
  std::array<std::uint32_t, 3> localSize{1, 1, 1};
  std::uint32_t groupMemoryBytes = 0;  ///< sum of its group-shared variables, padding between them left out
};

/// Throws kFailure with one line when the file is missing or is no SPIR-V module with one compute entry point.
SpirvModule readModule(const std::filesystem::path& path);

}  // namespace tessera::devices::vulkan
