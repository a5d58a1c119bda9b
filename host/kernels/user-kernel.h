// Kernels that a user brings in place of a stage's own: Slang, HLSL or GLSL, bound by reflection like any other.
#pragma once

#include <tessera/kernel-cache.h>
#include <tessera/kernel.h>

#include <filesystem>
#include <string>

namespace tessera::kernels {

enum class Language {
  kSlang,  ///< .slang
  kHlsl,   ///< .hlsl, which slangc reads
  kGlsl    ///< .comp or .glsl, which glslangValidator reads
};
/// By the file's extension. Throws kUsage for another, naming those there are.
Language languageOf(const std::filesystem::path& file);
/// That of the request's source or file.
Language languageOf(const KernelRequest& request);

/// The request made over to a user's file, with its entry point: of Slang and HLSL the one named as the stage's own,
/// else the only one; of GLSL main. Throws kUsage where the file cannot be read, has another extension, or no such
/// entry point; kUnsupported for GLSL on the CPU.
KernelRequest requestOf(KernelRequest own, const std::filesystem::path& file);

/// The module `settings` of a stage as GLSL: the same constants.
std::string glslSettings(const std::string& settings);

/// Throws unless the host can bind the user's kernel as it binds the stage's own: `own` is that kernel's interface and
/// `all` what the plan's own kernels bind, together. kUsage, naming the buffer or the uniform; kUnsupported where the
/// CPU would run a group of more than one thread.
void checkInterface(const CompiledKernel& users, const KernelInterface& own, const KernelInterface& all);

/// What checkSpirv() finds in it, as one line; "" if nothing.
std::string exactnessWarning(const CompiledKernel& users);

}  // namespace tessera::kernels
