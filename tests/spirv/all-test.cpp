// The same over every distinct kernel that any plan dispatches.
#include <catch2/catch.hpp>

#include "all-kernels.h"

using namespace tessera;
using namespace tessera::test;

TEST_CASE("all kernels compile to C++") {
  KernelCache cache;
  const std::vector<KernelRequest> kernels = allKernels(Route::kCpp);
  CHECK(cache.getAll(kernels).size() == kernels.size());
}

TEST_CASE("all SPIR-V of Slang is exact and valid") {
  KernelCache cache;
  CHECK(findings(cache, allKernels(Route::kSpirv)) == std::vector<std::string>{});
}

TEST_CASE("all SPIR-V by way of GLSL is exact and valid") {
  KernelCache cache;
  CHECK(findings(cache, allKernels(Route::kGlsl)) == std::vector<std::string>{});
}
