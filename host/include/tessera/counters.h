// The events that a frame counts: one list for the kernels, the host, the rows and the docs.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// How the counts of the parts that a frame was cut into become one count.
enum class CounterMerge {
  kSum,      ///< their sum
  kLargest,  ///< the largest of them
  kOnce,     ///< a sum over the batches of the first band: each band has all triangles
};

/// One counter of a frame: its name and what it counts.
struct CounterDoc {
  std::string name;     ///< lowerCamelCase; kernels know it as kCount + UpperCamelCase
  std::string meaning;  ///< one line
  bool inKernels;       ///< counted by kernels; else by the host
  bool work = false;    ///< only under counters=work
  CounterMerge merge = CounterMerge::kSum;  ///< over the parts of a frame
};

/// All counters, in pipeline order: first the kernels' counters, whose index is their index in the counter buffer, then
/// the host's counters.
const std::vector<CounterDoc>& counterDocs();
/// The counter of that name. Throws kFailure with the name where nothing counts it.
const CounterDoc& counterDoc(std::string_view name);
/// How many counters the kernels count.
std::size_t kernelCounterCount();
/// Index of a counter of the kernels in counterDocs(), by its name. Throws kFailure with the name where no kernel counts
/// it.
std::size_t counterIndex(std::string_view name);

}  // namespace tessera
