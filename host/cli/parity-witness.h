// Where every device is wrong alike: a variant that is right on the same device, so that the first wrong stage can be
// named.
#pragma once

#include <tessera/kernel-cache.h>
#include <tessera/rasterizer.h>
#include <tessera/variant.h>

#include <optional>
#include <string>

namespace tessera::cli {

/// What `variant` with `files` is held against: the same without the files, then without one of the settings that may
/// change no bit, then with none of them.
struct Witness {
  std::string name;  ///< "without --set edge=float32"
  Variant variant;
  bool files = false;  ///< the users' kernels run in it, too
};
std::vector<Witness> witnesses(const Variant& variant, bool hasFiles);

/// As firstStage(), for frames of two variants: the order of pieces is the variants' own, and so are bins where the
/// axes that make them differ.
std::string firstStageAgainst(const Frame& good, const Variant& goodVariant, const std::string& goodName,
                              const Frame& frame, const Variant& variant, const std::string& name);

}  // namespace tessera::cli
