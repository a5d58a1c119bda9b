// The events that a frame counts. The kernels, the host, the rows and the docs share one list.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// How the counts of a frame's parts (bands and batches) become one count.
enum class CounterMerge {
  kSum,      ///< the sum of the parts' counts
  kLargest,  ///< the largest of the parts' counts
  kOnce,     ///< the sum over the batches of the first band, since each band has all triangles
};

/// One counter of a frame: its name and what it counts.
struct CounterDoc {
  std::string name;                         ///< lowerCamelCase; kernels know it as kCount + UpperCamelCase
  std::string meaning;                      ///< what the counter counts, in one line
  bool inKernels;                           ///< whether kernels count it; otherwise the host does
  bool work = false;                        ///< whether it is counted under counters=work only
  CounterMerge merge = CounterMerge::kSum;  ///< how the counts of a frame's parts become one
};

/// All counters, in pipeline order. The kernels' counters come first; the index of each is also its index in the
/// counter buffer. The host's counters follow.
const std::vector<CounterDoc>& counterDocs();
/// The counter `name`. Throws kFailure with the name where no counter has this name.
const CounterDoc& counterDoc(std::string_view name);
/// The number of counters that the kernels count.
std::size_t kernelCounterCount();
/// The index in counterDocs() of the kernels' counter `name`. Throws kFailure with the name where the kernels have no
/// such counter.
std::size_t counterIndex(std::string_view name);

}  // namespace tessera
