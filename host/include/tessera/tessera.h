// All of the library: scenes from files, generators or memory; the rasteriser on its devices; the oracle; images.
#pragma once

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
