// A job's own process: it alone holds scenes, devices and kernels, so that what crashes or hangs costs one cell.
#pragma once

namespace tessera::harness {

/// Serves the messages of request.h on stdin and stdout until stdin ends. Ends with the process that started it. Exit
/// code of the program.
int serveWorker();

}  // namespace tessera::harness
