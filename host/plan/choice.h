// Chooses a value for each axis: the value that the user asked for, or else the first value that goes with the other
// axes' values and with the device.
#pragma once

#include <tessera/device.h>
#include <tessera/variant.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::plan {

/// What the value needs and the device lacks, in words. Nothing where the device has all that the value needs.
std::optional<std::string> missingNeed(const AxisValue& value, const DeviceInfo& device);

/// A resolved variant without the settings that mean nothing beside the others, such as a capacity where there are no
/// queues. Such a setting is refused where a user sets it. Where a user sets all settings that are left, the plan is
/// the same.
Variant settable(const Variant& resolved);

/// The choice of values for one plan, axis by axis.
class Choice {
 public:
  Choice(const Variant& asked, const DeviceInfo& device) : asked_(asked), device_(device) {}

  /// Takes the value that the user asked for, or else the first of `preferred` that the device can do and that goes
  /// with all values that were asked for or taken. Throws kUnsupported or kUsage where the value that the user asked
  /// for does not fit; the message says axis, value, reason, and what would work.
  std::string take(std::string_view axis, const std::vector<std::string>& preferred);
  /// The values that were taken.
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

}  // namespace tessera::plan
