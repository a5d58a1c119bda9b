// The events that a frame counts: one list for the kernels, the host, the rows and the docs.
#pragma once

#include <string>
#include <vector>

namespace tessera {

struct CounterDoc {
  std::string name;     ///< lowerCamelCase; kernels know it as kCount + UpperCamelCase
  std::string meaning;  ///< one line
  bool inKernels;       ///< counted by kernels; else by the host
  bool work = false;    ///< only under counters=work
};

/// In pipeline order; the kernels' ones first, the index of each is its index in the counter buffer.
const std::vector<CounterDoc>& counterDocs();
std::size_t kernelCounterCount();
/// Index of a kernel counter.
std::size_t counterIndex(std::string_view name);

}  // namespace tessera
