// What a user's kernel does to the process that bounds checks cannot see: the line that is said then.
#pragma once

namespace tessera {

/// From now on a signal that a kernel on the CPU device raises (an integer division by zero, an address that is not
/// there) ends the process with one line that names the kernel, and exit code 2. Without it, it ends as signals end a
/// process.
void sayKernelFaults();

/// The kernel that runs now, as messages call it; null: none. The text stays as long as the kernel.
void setRunningKernel(const char* description);
const char* runningKernel();

}  // namespace tessera
