// A value for each axis: the one asked for, or the first that goes with the others and with the device.
#pragma once

#include <tessera/device.h>
#include <tessera/variant.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// What of the value's needs the device lacks, in words; nothing if it has them all.
std::optional<std::string> missingNeed(const AxisValue& value, const DeviceInfo& device);

/// A resolved variant without what says nothing beside the rest, such as a capacity where there are no queues, and what
/// is therefore refused when it is set. With what is left set, the plan is the same.
Variant settable(const Variant& resolved);

class Choice {
 public:
  Choice(const Variant& asked, const DeviceInfo& device) : asked_(asked), device_(device) {}

  /// The value asked for, or else the first of `preferred` that the device can do and that goes with what was asked for
  /// and taken. Throws kUnsupported or kUsage where the one asked for does not: axis, value, reason, what would do.
  std::string take(std::string_view axis, const std::vector<std::string>& preferred);
  const Variant& resolved() const { return taken_; }

 private:
  std::string current(const std::string& axis) const { return taken_.get(axis, asked_.get(axis)); }
  const AxisRule* broken(const std::string& axis, const std::string& value) const;
  bool fits(const Axis& axis, const std::string& value) const;
  [[noreturn]] void refuse(const AxisRule& rule) const;

  const Variant& asked_;
  const DeviceInfo& device_;
  Variant taken_;
};

}  // namespace tessera
