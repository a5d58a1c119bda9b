// All of the library: scenes from files, generators or memory; the rasteriser on its devices; the oracle; images.
#pragma once

#include <tessera/array.h>
#include <tessera/counters.h>
#include <tessera/cpu-device.h>
#include <tessera/device-kind.h>
#include <tessera/device.h>
#include <tessera/error.h>
#include <tessera/framebuffer.h>
#include <tessera/image.h>
#include <tessera/input.h>
#include <tessera/kernel-cache.h>
#include <tessera/kernel.h>
#include <tessera/oracle.h>
#include <tessera/plan.h>
#include <tessera/probe.h>
#include <tessera/rasterizer.h>
#include <tessera/scene.h>
#include <tessera/variant.h>
#include <tessera/vulkan-device.h>

/// \mainpage
/// Tessera rasterises triangles in compute shaders, with the same bits on every device. A program includes
/// <tessera/tessera.h> and links tessera::tessera, which find_package(tessera) gives:
///
/// \include sphere.cpp
///
/// The classes stand under Classes, the functions under tessera (Namespaces). What an image is, bit for bit, stands at
/// the head of tessera/rasterizer.h (Files). Every failure is an exception of the class tessera::Error.

/// The library: tessera::loadInput() makes a scene, tessera::openDevice() opens a device, tessera::Rasterizer renders a
/// frame and tessera::writeImage() writes a file.
namespace tessera {}
