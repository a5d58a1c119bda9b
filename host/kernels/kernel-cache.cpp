#include <fmt/format.h>
#include <tessera/error.h>
#include <tessera/kernel-cache.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <system_error>
#include <thread>

#include "host/axes/routes.h"
#include "host/kernels/compiler-tools.h"
#include "host/kernels/reflection.h"
#include "host/kernels/slang-compiler.h"
#include "host/kernels/slang-sources.h"
#include "host/kernels/user-kernel.h"
#include "host/support/file-faults.h"
#include "host/support/files.h"
#include "host/support/home.h"
#include "host/support/own-files.h"
#include "host/support/sha256.h"

#ifndef TESSERA_KERNEL_CXX_FLAGS
#define TESSERA_KERNEL_CXX_FLAGS ""
#endif

namespace tessera {
namespace {

namespace fs = std::filesystem;

/// Raised when an entry's files or what makes them changes, so that old entries are not found.
constexpr const char* kFormat = "tessera kernel 2";

std::vector<std::string> splitWords(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), {}};
}

/// $TESSERA_SLANG_SOURCES, else what was installed with this program, else the folder that this build came from.
fs::path defaultSlangSources() {
  if (const char* folder = std::getenv("TESSERA_SLANG_SOURCES"); folder != nullptr && *folder != '\0') return folder;
  return support::home().slang;
}

/// An entry is a folder with the binary and this: the hash of the binary, and the interface with its own.
constexpr const char* kInterfaceFile = "interface.json";

std::string entryText(const KernelInterface& interface, const std::string& binary) {
  const nlohmann::json stored = kernels::toJson(interface);
  return nlohmann::json{
      {"interface", stored}, {"interfaceHash", support::sha256(stored.dump())}, {"binaryHash", support::sha256(binary)}}
      .dump(1);
}

std::optional<KernelInterface> readWhole(const fs::path& entry, Route route) try {
  const nlohmann::json stored = nlohmann::json::parse(kernels::readText(entry / kInterfaceFile));
  if (stored.at("binaryHash") != support::sha256(kernels::readText(entry / axes::routeInfo(route).binary))) return {};
  if (stored.at("interfaceHash") != support::sha256(stored.at("interface").dump())) return {};
  return kernels::interfaceFromJson(stored.at("interface"));
} catch (const nlohmann::json::exception&) {
  return {};
} catch (const Error&) {
  return {};
}

/// The interface of a whole entry; nothing where a file is missing, cut short or changed.
std::optional<KernelInterface> readEntry(const fs::path& entry, Route route) {
  // They run as this process does: whoever can write them is it.
  for (const fs::path& path :
       {entry.parent_path(), entry, entry / kInterfaceFile, entry / axes::routeInfo(route).binary})
    support::checkOwn(path);
  return readWhole(entry, route);
}

}  // namespace

struct KernelCache::State {
  Options options;
  kernels::ToolMemory memory;
  std::vector<std::string> cxxFlags;
  std::atomic<std::size_t> hits{0}, compiled{0}, rebuilt{0};
  std::mutex toolsMutex;
  std::optional<ToolInfo> slangc, glslang;
  std::optional<kernels::CxxInfo> cxx;

  explicit State(Options given)
      : options(std::move(given)), memory(options.folder), cxxFlags(splitWords(TESSERA_KERNEL_CXX_FLAGS)) {
    for (std::string& flag : splitWords(options.extraCxxFlags)) cxxFlags.push_back(std::move(flag));
  }

  /// Tools are looked for when the first kernel needs them: the command line's other work needs none.
  template <typename Tool, typename Find>
  const Tool& tool(std::optional<Tool>& place, const Find& find) {
    const std::lock_guard lock(toolsMutex);
    if (!place) place = find(memory);
    return *place;
  }

  const ToolInfo& slangcInUse() {
    return tool(slangc, [&](kernels::ToolMemory& known) {
      return kernels::chooseSlangc(known, support::slangcOf(options.slangSources));
    });
  }

  kernels::CompileSettings settings(const KernelRequest& request) {
    kernels::CompileSettings settings;
    const axes::RouteInfo& route = axes::routeInfo(request.route);
    const bool glsl = kernels::languageOf(request) == kernels::Language::kGlsl;
    if (!glsl) settings.slangc = slangcInUse();
    if (route.then == axes::SecondCompiler::kCxx) settings.cxx = tool(cxx, kernels::resolveCxx);
    if (route.then == axes::SecondCompiler::kGlslang || glsl) settings.glslang = tool(glslang, kernels::resolveGlslang);
    settings.slangSources = options.slangSources;
    settings.boundsChecks = options.boundsChecks && route.compiledChecks;
    settings.cxxFlags = cxxFlags;
    return settings;
  }

  std::string key(const KernelRequest& request, const kernels::CompileSettings& settings,
                  const std::map<fs::path, std::string>& sources) const {
    std::string all;
    const auto add = [&](std::string_view part) {
      all += fmt::format("{}:", part.size()).append(part);
    };  // lengths keep parts apart
    add(kFormat);
    const bool glsl = kernels::languageOf(request) == kernels::Language::kGlsl;
    add(request.file.empty() ? request.source : request.stage + request.file.extension().string());
    add(request.entry);
    add(request.modules.settings);
    add(request.modules.variant);
    add(settings.slangc.version);
    if (!glsl)
      for (const std::string& flag : axes::routeInfo(request.route).slangFlags) add(flag);
    for (const fs::path& folder : kernels::searchFolders(""))
      add(folder.string());  // their order says which of two files is read
    for (const auto& [path, text] : sources)
      add(fs::absolute(path).lexically_normal().lexically_relative(settings.slangSources).string()), add(text);
    add(settings.glslang.version);
    if (axes::routeInfo(request.route).then == axes::SecondCompiler::kCxx) {
      add(kernels::machineText(
          settings.slangSources,
          std::ranges::any_of(sources, [](const auto& source) { return kernels::usesLanes(source.second); }),
          request.modules.laneWidth));
      add(settings.cxx.version);
      add(settings.cxx.targetMacros);
      for (const std::string& flag : kernels::cxxBaseFlags()) add(flag);
      for (const std::string& flag : settings.cxxFlags) add(flag);
      add(settings.boundsChecks ? "bounds checks 2" : "");
    }
    return support::sha256(all);
  }

  /// Where a kernel is kept, and what it is made from.
  struct Place {
    kernels::CompileSettings settings;
    std::map<fs::path, std::string> sources;
    std::string hash;
    fs::path entry;
  };
  Place placeOf(const KernelRequest& request) {
    Place place{.settings = settings(request), .sources = {}, .hash = {}, .entry = {}};
    const fs::path source = request.file.empty() ? place.settings.slangSources / request.source : request.file;
    place.sources = kernels::slangSources(place.settings.slangSources, source, request.modules.text());
    place.hash = key(request, place.settings, place.sources);
    place.entry = options.folder / place.hash.substr(0, 2) / place.hash;
    return place;
  }

  /// Compiles beside the entry and renames the files into it, the interface last. Two that do so at once rename the
  /// same bytes; should a compiler be less deterministic than that, the hashes tell and the entry is built again.
  KernelInterface fill(const KernelRequest& request, const kernels::CompileSettings& settings,
                       const std::map<fs::path, std::string>& sources, const fs::path& entry) try {
    if (std::error_code ignored; fs::exists(entry, ignored) && !fs::is_directory(entry, ignored))
      fs::remove(entry, ignored);
    support::makeOwnFolder(entry);
    const support::TemporaryFolder work(options.folder, "work");
    const KernelInterface interface = kernels::compileKernel(request, settings, sources, work.path());
    const fs::path made = work.path() / axes::routeInfo(request.route).binary, binary = entry / made.filename();
    const std::string text = entryText(interface, kernels::readText(made));
    support::makeOwn(made);
    support::replaceOwn(made, binary);
    support::writeOwn(entry / kInterfaceFile, text);
    return interface;
  } catch (const std::system_error& error) {
    throw Error(support::codeOf(error.code().value()),
                fmt::format("kernel cache: {}: {}; a TESSERA_CACHE that can be written and has room would do",
                            entry.string(), error.code().message()));
  }
};

KernelCache::KernelCache() : KernelCache(Options{}) {}

KernelCache::KernelCache(Options options) {
  if (options.folder.empty()) options.folder = support::defaultCacheFolder();
  if (options.slangSources.empty()) options.slangSources = defaultSlangSources();
  options.folder = fs::absolute(options.folder).lexically_normal();
  options.slangSources = fs::absolute(options.slangSources).lexically_normal();
  if (!fs::is_directory(options.slangSources))
    failUsage(fmt::format(
        "{}: no such folder; the kernels' Slang sources are looked for there: set TESSERA_SLANG_SOURCES to them",
        options.slangSources.string()));
  support::checkOwn(options.folder);
  state_ = std::make_unique<State>(std::move(options));
}

KernelCache::~KernelCache() = default;

bool KernelCache::has(const KernelRequest& request) {
  const State::Place place = state_->placeOf(request);
  return readEntry(place.entry, request.route).has_value();
}

CompiledKernel KernelCache::get(const KernelRequest& request) {
  const auto [settings, sources, hash, entry] = state_->placeOf(request);
  CompiledKernel kernel{request.stage, kernels::binaryEntry(request),
                        request.route, entry / axes::routeInfo(request.route).binary,
                        hash,          {},
                        request.file,  ""};
  if (!request.file.empty()) kernel.fileHash = support::sha256(sources.at(request.file.lexically_normal()));
  if (auto found = readEntry(entry, request.route)) {
    ++state_->hits;
    kernel.interface = std::move(*found);
    return kernel;
  }
  if (std::error_code error; fs::exists(entry / kInterfaceFile, error)) ++state_->rebuilt;
  kernel.interface = state_->fill(request, settings, sources, entry);
  ++state_->compiled;
  return kernel;
}

std::vector<CompiledKernel> KernelCache::getAll(const std::vector<KernelRequest>& requests,
                                                const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<CompiledKernel> kernels(requests.size());
  std::atomic<std::size_t> next{0};
  std::mutex mutex;  // guards done, failure and the callback
  std::size_t done = 0;
  std::exception_ptr failure;
  const auto work = [&] {
    for (std::size_t i; (i = next++) < requests.size();) {
      try {
        kernels[i] = get(requests[i]);
        const std::lock_guard lock(mutex);
        if (++done; progress) progress(done, requests.size());
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = requests.size();
      }
    }
  };
  {
    std::vector<std::jthread> others;
    const std::size_t most = std::min<std::size_t>(requests.size(), std::thread::hardware_concurrency());
    try {
      while (others.size() + 1 < most) others.emplace_back(work);
    } catch (const std::system_error&) {
      // with fewer threads it takes longer
    }
    work();
  }
  if (failure) std::rethrow_exception(failure);
  return kernels;
}

const KernelFiles& KernelCache::files() const { return state_->options.files; }

const ToolInfo& KernelCache::slangc() const { return state_->slangcInUse(); }

std::string KernelCache::cxx() const {
  const kernels::CxxInfo& cxx = state_->tool(state_->cxx, kernels::resolveCxx);
  std::vector<std::string> flags = kernels::cxxBaseFlags();
  flags.insert(flags.end(), state_->cxxFlags.begin(), state_->cxxFlags.end());
  return fmt::format("{}, {} ({})", cxx.version, fmt::join(flags, " "), cxx.target);
}

fs::path KernelCache::folder() const { return state_->options.folder; }

fs::path KernelCache::sourcesFolder() const { return state_->options.slangSources; }

KernelCache::Statistics KernelCache::statistics() const { return {state_->hits, state_->compiled, state_->rebuilt}; }

}  // namespace tessera
