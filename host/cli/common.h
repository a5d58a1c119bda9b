// What several commands share: their options, and how text becomes a variant, a scene, a device.
#pragma once

#include <tessera/device.h>
#include <tessera/input.h>
#include <tessera/kernel-cache.h>
#include <tessera/scene.h>
#include <tessera/variant.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace tessera::cli {

/// Options as they were typed. Each command adds those that it takes.
struct Options {
  std::string input;
  std::string size;                   ///< "WxH" or "W"; empty: the scene's
  std::vector<std::string> settings;  ///< "axis=value", or more of them with commas or blanks between
  std::vector<std::string> kernels;   ///< "STAGE=FILE"
  std::vector<std::string> devices;   ///< names as openDevice() takes them
  std::string attribute, range;       ///< its name; "A,B"
  unsigned threads = 0;               ///< of devices that take a number; 0: all cores
  bool quiet = false;                 ///< no progress and no summary
};

void addInput(CLI::App& app, Options& options);
void addSettings(CLI::App& app, Options& options);
void addAttribute(CLI::App& app, Options& options);
void addKernelFiles(CLI::App& app, Options& options);
void addThreads(CLI::App& app, Options& options);
/// A whole number from `least` to `most`; another one gets a message that names the two.
CLI::Option* addCount(CLI::App& app, const std::string& name, unsigned& count, unsigned least, unsigned most,
                      const std::string& text);
void addRepeat(CLI::App& app, unsigned& repeat);
/// `many`: the option may be repeated.
void addDevice(CLI::App& app, Options& options, bool many);
void addQuiet(CLI::App& app, bool& quiet);

/// Each setting alone, as "axis=value".
std::vector<std::string> typedSettings(const Options& options);
Variant variantOf(const Options& options);
/// The user's kernels, of which each file is there and in a language that we know. Throws kUsage.
KernelFiles kernelFilesOf(const Options& options);
/// --attribute and --range.
AttributeRequest attributeOf(const Options& options);
/// Loads the input and its attribute, and prints its notes; a size that was given replaces the scene's, and its camera
/// follows.
Scene sceneOf(const Options& options);
/// The name of the one device of a command that takes one: the default device unless another was named.
std::string deviceName(const Options& options);
/// The device itself.
std::unique_ptr<Device> deviceOf(const Options& options);

/// What stands between the commas of an option's value, without blanks around it. Throws kUsage where it is nothing,
/// saying that `right` would be right.
std::vector<std::string> partsOf(const std::string& typed, const std::string& option, const std::string& right);
/// All files that the command reads: the input, what a scene names, the user's kernels.
std::vector<std::filesystem::path> inputsOf(const Options& options);

/// A word as a shell takes it, in quotes where it needs them.
std::string quoted(const std::string& word);

}  // namespace tessera::cli
