// Which kernels there are: found by asking the plan, so that a new axis or value is in every test below.
#pragma once

#include <vector>

#include "host/plan/stages.h"

namespace tessera::test {

/// A triangle that needs no clipping and no perspective division, so that no value of an axis is refused on its account;
/// in object space with normals, or in clip space.
Scene simpleScene(bool objectSpace);

/// Distinct kernels of a stage that some plan dispatches on this route, such that each set of `strength` values of the axes
/// that it reads is in one of them. Their product is beyond compiling: raster-tiles alone has some 10^5 kernels.
std::vector<KernelRequest> kernelsOf(const plan::Stage& stage, Route route, std::size_t strength = 1);
/// Of all stages.
std::vector<KernelRequest> coveringKernels(Route route, std::size_t strength);

/// The "axis=value" words of a kernel's variant.
std::vector<std::string> settingsOf(const KernelRequest& kernel);

/// What spirv-val says about words written to a file, empty if it is content; Vulkan 1.2.
std::string spirvVal(const std::vector<std::uint32_t>& words);
/// Compiles them and collects what checkSpirv() and spirv-val find, a line each: none is good.
std::vector<std::string> findings(KernelCache& cache, const std::vector<KernelRequest>& kernels);

}  // namespace tessera::test
