// The Slang files that a kernel reads, found without running slangc: their text goes into the cache's key.
#pragma once

#include <tessera/error.h>

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::kernels {

/// Folders under `root` in which slangc looks for an imported module, in this order: each room of slang/README.md that
/// kernels import from, then `root` itself. They need not exist.
std::vector<std::filesystem::path> searchFolders(const std::filesystem::path& root);

/// Path -> text of `entry` and of every file that it, or the generated modules' text, names by import, __include,
/// implementing or #include, transitively. `import a.b_c` is a/b-c.slang or a/b_c.slang, beside the importing file or
/// under one of searchFolders(root); all that exist are taken, so the set may hold more than slangc reads, never less
/// (the compiler checks that against slangc's own list). Throws kUsage if one of them cannot be read.
std::map<std::filesystem::path, std::string> slangSources(const std::filesystem::path& root,
                                                          const std::filesystem::path& entry,
                                                          const std::string& generated);

/// Whether a text of Slang, or the C++ that slangc writes from it, names the lane types of machine/lanes-cpp.h.
bool usesLanes(std::string_view text);

/// The C++ text that stands ahead of what slangc writes in C++: machine/atomics-cpp.h under `root`. Where `lanes` is set
/// also machine/lanes-cpp.h, for vectors of `laneWidth` lanes (0: as wide as the processor's). A file that does not exist
/// is left out. Throws as readText() does.
std::string machineText(const std::filesystem::path& root, bool lanes, unsigned laneWidth);

/// Whole file. Throws `refusal` if the name leads to no file or to one that may not be read: kUsage is right where a
/// user named it. kFailure for a shortage.
std::string readText(const std::filesystem::path& path, ExitCode refusal = ExitCode::kFailure);

}  // namespace tessera::kernels
