// Bounds checks in a SPIR-V module, for a device that has none: an index out of range becomes 0 and leaves a record.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tessera::kernels {

/// What the host reads and writes in the storage buffer that a checked module has beside its own, in 32-bit words. The
/// first fault is kept; no later one overwrites it.
enum FaultWord : std::uint32_t {
  kFaultAccess,  ///< 0: none, else 1 + its place in CheckedSpirv::accesses; the host sets it to 0 before a dispatch
  kFaultIndex,   ///< its low 32 bits
  kFaultHigh,    ///< of an index of 64 bits the others
  kFaultCount,   ///< elements that there are
  kFaultWords    ///< from here on what the host gives: the elements of each of CheckedSpirv::counted
};

struct CheckedSpirv {
  struct Access {
    std::string what;  ///< what the index is into, as messages call it: "`depth`", "an array in it"
    bool isSigned;     ///< whether the index is
    bool isWide;       ///< whether it has 64 bits
  };
  std::vector<std::uint32_t> words;
  std::uint32_t binding = 0;         ///< in set 0, of that storage buffer
  std::vector<std::string> counted;  ///< storage buffers of the kernel whose lengths the host has to give
  std::vector<Access> accesses;
};

/// Checks each index that can be out of range: into storage buffers, arrays, vectors and matrices, wherever they lie.
/// The lengths of storage buffers are the host's, and so are those that the kernel asks for: what is bound may be
/// larger. `resources`: KernelInterface::resources. Nothing else changes what the module computes. Throws kUsage for a
/// module that computes addresses, which no check can follow.
CheckedSpirv addBoundsChecks(const std::vector<std::uint32_t>& words,
                             const std::map<std::string, std::uint32_t>& resources);

}  // namespace tessera::kernels
