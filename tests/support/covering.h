// Covering designs: few variants that hold every pair (or triple) of values (Cohen, Dalal, Fredman and Patton, "The AETG
// system", IEEE Transactions on Software Engineering 23(7), 1997, for testing by them).
#pragma once

#include <tessera/variant.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace tessera::test {

/// An axis and those of its values that take part.
using AxisValues = std::pair<std::string, std::vector<std::string>>;

/// Variants on top of `base` such that each set of `strength` values of different axes that `accepts` takes, on top of
/// `base`, is in one of them. An axis of which none is accepted beside the others of a variant is left unset in it.
std::vector<Variant> covering(const Variant& base, const std::vector<AxisValues>& axes, std::size_t strength,
                              const std::function<bool(const Variant&)>& accepts);

}  // namespace tessera::test
