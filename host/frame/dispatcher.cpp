#include "host/frame/dispatcher.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>
#include <cstring>

#include "host/plan/buffers.h"

namespace tessera::frame {
namespace {

/// A kernel binds the buffers of the pipeline, and the streams of the scene under their own names.
void checkBuffers(const CompiledKernel& kernel, const Scene& scene) {
  for (const auto& [name, bytes] : kernel.interface.elementSizes) {
    const plan::BufferDoc* const doc = plan::findBuffer(name);
    if (doc == nullptr && scene.stream(name) == nullptr)
      fail(fmt::format("stage {}: `{}` is neither a buffer of the pipeline nor a stream of the scene", kernel.stage,
                       name));
    if (doc != nullptr && doc->bytes % bytes != 0)
      fail(fmt::format("stage {}: an element of `{}` has {} bytes in the kernel, {} in the list of buffers",
                       kernel.stage, name, bytes, doc->bytes));
  }
}

}  // namespace

void Dispatcher::prepare(const Plan& plan, const Scene& scene) {
  const std::vector<CompiledKernel> compiled = plan::compileStages(cache_, plan);
  kernels_.clear();
  used_.clear();
  plan_ = plan;
  for (const CompiledKernel& stage : compiled) {
    checkBuffers(stage, scene);
    auto& kernel = loaded_[stage.hash];
    if (!kernel) kernel = device_.createKernel(stage);
    kernels_[stage.stage] = kernel.get();
    for (const auto& [name, bytes] : stage.interface.elementSizes) used_.insert(name);
  }
}

std::uint32_t Dispatcher::get(std::string_view field) const {
  const auto found = uniforms_.find(field);
  if (found == uniforms_.end()) fail(fmt::format("nothing sets the uniform {}", field));
  return found->second;
}

std::uint64_t Dispatcher::count(plan::Extent extent) const {
  return tessera::plan::count(extent, [this](std::string_view field) -> std::uint64_t { return get(field); });
}

std::uint64_t Dispatcher::bytesOf(std::string_view buffer) const {
  const plan::BufferDoc& doc = plan::bufferDoc(buffer);
  return doc.bytes * count(doc.extent);
}

bool Dispatcher::fits(std::string_view buffer) const { return fits(buffer, count(plan::bufferDoc(buffer).extent)); }

bool Dispatcher::fits(std::string_view buffer, std::uint64_t elements) const {
  return elements <= kMaxWord && elements * plan::bufferDoc(buffer).bytes <= device_.info().maxBufferBytes;
}

Buffer& Dispatcher::allocate(std::string_view buffer, std::string_view as) { return reserve(as, bytesOf(buffer)); }

void Dispatcher::allocateAll(plan::Extent extent) {
  for (const plan::BufferDoc& doc : plan::buffers())
    if (doc.extent == extent && uses(doc.name) && !inputs_.contains(doc.name) && !aliases_.contains(doc.name))
      allocate(doc.name);
}

Buffer& Dispatcher::reserve(std::string_view name, std::size_t bytes) {
  auto& buffer = buffers_[std::string(name)];
  if (!buffer || buffer->bytes() < bytes) {
    if (buffer) device_.finish();  // what was recorded may use the old one
    buffer.reset();                // before the new one is made: both need not fit
    buffer = device_.createBuffer(bytes, name);
  }
  return *buffer;
}

Buffer& Dispatcher::held(std::string_view name) {
  if (const auto input = inputs_.find(name); input != inputs_.end()) return *input->second.buffer;
  const auto found = buffers_.find(name);
  if (found == buffers_.end() || !found->second) fail(fmt::format("nothing has made the buffer `{}`", name));
  return *found->second;
}

void Dispatcher::inputBytes(std::string_view name, std::span<const std::byte> bytes) {
  if (auto borrowed = device_.borrow(bytes, name)) {
    inputs_.insert_or_assign(std::string(name), Input{bytes, std::move(borrowed)});
    return;
  }
  copyInput(name, bytes);
}

void Dispatcher::copyInput(std::string_view name, std::span<const std::byte> bytes) {
  Buffer& copy = reserve(name, bytes.size());
  if (!bytes.empty()) device_.write(copy, 0, bytes);
}

void Dispatcher::drop(const std::function<bool(std::string_view)>& gone) {
  if (std::ranges::any_of(buffers_, [&](const auto& entry) { return gone(entry.first); }))
    device_.finish();  // what was recorded may use them
  std::erase_if(buffers_, [&](const auto& entry) { return gone(entry.first); });
  std::erase_if(aliases_, [&](const auto& entry) { return gone(entry.second); });
}

void Dispatcher::dropInputs() {
  if (inputs_.empty()) return;
  device_.finish();
  inputs_.clear();
}

void Dispatcher::zero(std::string_view name, std::size_t words, std::size_t first) {
  device_.fill(held(name), 4 * first, 4 * words, 0);
}

Buffer& Dispatcher::bound(const KernelInterface& interface, const std::string& resource) {
  const auto alias = aliases_.find(resource);
  const std::string& name = alias == aliases_.end() ? resource : alias->second;
  const auto input = inputs_.find(name);
  // A kernel names every buffer of its modules, also those that its variant never touches and nobody made.
  if (input == inputs_.end()) return reserve(name, 0);
  if (!interface.writable.contains(resource)) return *input->second.buffer;
  const std::span<const std::byte> memory = input->second.memory;
  inputs_.erase(input);
  copyInput(name, memory);
  return held(name);
}

void Dispatcher::dispatch(std::string_view name) {
  const auto found = kernels_.find(name);
  if (found == kernels_.end()) fail(fmt::format("stage {}: the plan does not run it", name));
  const Kernel& kernel = *found->second;
  const KernelInterface& interface = kernel.compiled().interface;
  std::vector<std::byte> block(interface.blockSize);
  for (const auto& [field, place] : interface.fields) {
    const auto value = uniforms_.find(field);
    if (value == uniforms_.end()) fail(fmt::format("stage {}: nothing sets the uniform {}", name, field));
    std::memcpy(block.data() + place.offset, &value->second, sizeof value->second);
  }
  std::vector<Binding> bindings;
  for (const auto& [resource, where] : interface.resources)
    if (resource != "frame") bindings.push_back({resource, &bound(interface, resource)});
  const std::uint64_t groups =
      plan::groupsOf(plan::stageOf(name), [this](std::string_view field) -> std::uint64_t { return get(field); });
  device_.dispatch(kernel, bindings, block, static_cast<std::uint32_t>(groups));
}

void Dispatcher::dispatchAll(plan::Moment moment) {
  for (const std::string& stage : plan_.stages)
    if (plan::stageOf(stage).moment == moment) dispatch(stage);
}

}  // namespace tessera::frame
