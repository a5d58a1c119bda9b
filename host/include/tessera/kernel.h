// A compiled kernel as a device takes it: one binary, one entry point, and where each parameter goes.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace tessera {

/// How Slang reaches the machine: the values of the axis `route`, "cpp", "spirv" and "glsl". A device says which it
/// takes.
enum class Route {
  kCpp,    ///< "cpp": Slang to C++ to a shared object
  kSpirv,  ///< "spirv": Slang to SPIR-V
  kGlsl    ///< "glsl": Slang to GLSL, by glslang to SPIR-V
};

/// Where the parameters of a kernel go, read from slangc's reflection JSON or from the SPIR-V itself; no layout is
/// retyped by hand.
struct KernelInterface {
  /// A field of the uniform block.
  struct Field {
    std::uint32_t offset = 0;  ///< bytes from the block's start
    std::uint32_t size = 0;    ///< bytes
    bool floating = false;     ///< float32; else an integer
  };
  std::map<std::string, Field> fields;  ///< fields of the one ConstantBuffer, `frame`
  std::uint32_t blockSize = 0;          ///< bytes of that block
  /// Resource name -> descriptor binding in set 0 (kSpirv, kGlsl) or byte offset in the global struct (kCpp: the block
  /// is a pointer; a structured buffer is a pointer followed by a 64-bit element count). The block is among them as
  /// "frame".
  std::map<std::string, std::uint32_t> resources;
  std::map<std::string, std::uint32_t> elementSizes;  ///< bytes of one element of each structured buffer
  std::set<std::string> writable;                     ///< structured buffers that it may write
  std::array<std::uint32_t, 3> groupSize{1, 1, 1};    ///< threads of a workgroup
  std::uint32_t globalsSize = 0;                      ///< kCpp: bytes of the global struct
};

/// A kernel that the kernel cache has compiled and that Device::createKernel() takes.
struct CompiledKernel {
  std::string stage;  ///< the stage's name, as in variant.h
  std::string entry;  ///< entry point in the binary
  Route route = Route::kCpp;     ///< how it was compiled; the device has to take that route
  std::filesystem::path binary;  ///< shared object (kCpp) or SPIR-V module
  std::string hash;              ///< content hash: sources, variant, flags, compilers
  KernelInterface interface;     ///< where its parameters go
  std::filesystem::path file;  ///< a user's kernel, in place of the stage's own; else empty
  std::string fileHash;        ///< SHA-256 of that file
};

}  // namespace tessera
