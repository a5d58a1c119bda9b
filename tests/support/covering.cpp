#include "covering.h"

#include <algorithm>
#include <set>

namespace tessera::test {
namespace {

/// A value as the indices of its axis and of itself there; sets of them are in the order of axes.
using Value = std::pair<std::size_t, std::size_t>;
using Values = std::vector<Value>;

class Design {
 public:
  Design(const Variant& base, const std::vector<AxisValues>& axes, std::size_t strength,
         const std::function<bool(const Variant&)>& accepts)
      : base_(base), axes_(axes), strength_(std::min(strength, axes.size())), accepts_(accepts) {}

  std::vector<Variant> run() {
    collect({}, 0);
    std::vector<Variant> design;
    while (!missing_.empty()) design.push_back(next());
    return design;
  }

 private:
  Variant variantOf(const Values& values) const {
    Variant variant = base_;
    for (const auto& [axis, value] : values) variant.set(axes_[axis].first, axes_[axis].second[value]);
    return variant;
  }
  bool accepted(const Values& values) const { return accepts_(variantOf(values)); }

  /// All accepted sets of `strength` values, to be covered.
  void collect(const Values& chosen, std::size_t from) {
    if (!chosen.empty() && !accepted(chosen)) return;
    if (chosen.size() == strength_) {
      missing_.insert(chosen);
      return;
    }
    for (std::size_t axis = from; axis < axes_.size(); ++axis)
      for (std::size_t value = 0; value < axes_[axis].second.size(); ++value) {
        Values more = chosen;
        more.emplace_back(axis, value);
        collect(more, axis + 1);
      }
  }

  /// Calls `found` with each missing set that `value` makes with others of `chosen`.
  template <typename Found>
  void forEachMissing(const Values& chosen, const Value& value, const Found& found) const {
    Values set;
    const auto choose = [&](auto& self, std::size_t from) -> void {
      if (set.size() + 1 == strength_) {
        Values whole = set;
        whole.insert(std::ranges::upper_bound(whole, value), value);
        if (missing_.contains(whole)) found(whole);
        return;
      }
      for (std::size_t i = from; i < chosen.size(); ++i) {
        if (chosen[i] == value) continue;
        set.push_back(chosen[i]);
        self(self, i + 1);
        set.pop_back();
      }
    };
    choose(choose, 0);
  }

  /// From a set that is missing, axis by axis the value that covers most of what is missing.
  Variant next() {
    Values chosen = *missing_.begin();
    for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
      if (std::ranges::any_of(chosen, [&](const Value& v) { return v.first == axis; })) continue;
      Values best;
      std::size_t most = 0;
      for (std::size_t value = 0; value < axes_[axis].second.size(); ++value) {
        Values more = chosen;
        more.insert(std::ranges::upper_bound(more, Value{axis, value}), Value{axis, value});
        std::size_t covers = 0;
        forEachMissing(chosen, {axis, value}, [&](const Values&) { ++covers; });
        if ((best.empty() || covers > most) && accepted(more)) best = more, most = covers;
      }
      if (!best.empty()) chosen = best;
    }
    std::vector<Values> covered;
    for (const Value& value : chosen)
      forEachMissing(chosen, value, [&](const Values& set) { covered.push_back(set); });
    for (const Values& set : covered) missing_.erase(set);
    return variantOf(chosen);
  }

  const Variant& base_;
  const std::vector<AxisValues>& axes_;
  std::size_t strength_;
  const std::function<bool(const Variant&)>& accepts_;
  std::set<Values> missing_;
};

}  // namespace

std::vector<Variant> covering(const Variant& base, const std::vector<AxisValues>& axes, std::size_t strength,
                              const std::function<bool(const Variant&)>& accepts) {
  if (axes.empty()) return {base};
  return Design(base, axes, strength, accepts).run();
}

}  // namespace tessera::test
