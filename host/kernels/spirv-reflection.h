// The interface of a kernel that came without slangc's reflection JSON, from the SPIR-V module itself.
#pragma once

#include <tessera/kernel.h>

#include <cstdint>
#include <vector>

namespace tessera::kernels {

/// Names come from the module's debug names, as glslang writes them. A storage block holds one run-time array and
/// nothing else; the buffer's name is the block's instance name, or the array's where the block has none. The one
/// uniform block is called `frame`, either way. Throws kUsage, naming it, for what a kernel of ours cannot have: other
/// resources, other descriptor sets, two of one binding.
KernelInterface readSpirvInterface(const std::vector<std::uint32_t>& words);

}  // namespace tessera::kernels
