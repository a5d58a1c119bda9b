// manifest.json beside emitted kernels: all that somebody else's host needs to run them. host/languages.md describes
// it.
#pragma once

#include <tessera/plan.h>
#include <tessera/scene.h>
#include <tessera/variant.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "host/kernels/emit.h"

namespace tessera::cli {

/// A stage as it was written, and the file's name; "" where the target cannot take it.
struct WrittenStage {
  kernels::Emitted emitted;
  std::string file;
};

struct Manifest {
  std::string text;
  std::map<std::string, std::vector<std::byte>> files;  ///< what it names beside the stages, relative to its folder
  std::string complaint;  ///< why it has no commands: the frame could not be run here; else ""
};

/// `plan` is that of the stages, made of `asked`. The frame runs once on the default device, for its commands.
Manifest manifestOf(const Scene& scene, const Variant& asked, const Plan& plan, const kernels::EmitTarget& target,
                    const std::vector<WrittenStage>& stages);

}  // namespace tessera::cli
