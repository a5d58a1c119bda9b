// The same over triples: any three values of axes that a stage reads are in a kernel together.
#include <catch2/catch.hpp>
#include <set>

#include "all-kernels.h"

using namespace tessera;
using namespace tessera::test;

TEST_CASE("kernels of all triples compile to C++") {
  KernelCache cache;
  const std::vector<KernelRequest> kernels = coveringKernels(Route::kCpp, 3);
  std::set<std::string> binaries;
  for (const CompiledKernel& kernel : cache.getAll(kernels)) binaries.insert(kernel.hash);
  CHECK(binaries.size() == kernels.size());
}

TEST_CASE("SPIR-V of Slang of all triples is exact and valid") {
  KernelCache cache;
  CHECK(findings(cache, coveringKernels(Route::kSpirv, 3)) == std::vector<std::string>{});
}

TEST_CASE("SPIR-V by way of GLSL of all triples is exact and valid") {
  KernelCache cache;
  CHECK(findings(cache, coveringKernels(Route::kGlsl, 3)) == std::vector<std::string>{});
}
