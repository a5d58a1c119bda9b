// The events that a frame counts: one list for the kernels, the host, the rows and the docs.
#pragma once

#include <string>
#include <vector>

namespace tessera {

/// One counter of a frame: its name and what it counts.
struct CounterDoc {
  std::string name;     ///< lowerCamelCase; kernels know it as kCount + UpperCamelCase
  std::string meaning;  ///< one line
  bool inKernels;       ///< counted by kernels; else by the host
  bool work = false;    ///< only under counters=work
};

/// All counters, in pipeline order: first the kernels' counters, whose index is their index in the counter buffer, then
/// the host's counters.
const std::vector<CounterDoc>& counterDocs();
/// How many counters the kernels count.
std::size_t kernelCounterCount();
/// Index of a counter of the kernels in counterDocs(), by its name. Throws std::logic_error for a name that no kernel
/// counts.
std::size_t counterIndex(std::string_view name);

}  // namespace tessera
