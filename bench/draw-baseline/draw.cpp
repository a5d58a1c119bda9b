#include "bench/draw-baseline/draw.h"

#include <fmt/format.h>
#include <tessera/oracle.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>

#include "draw-frag.h"  // from draw.frag and draw.vert, by glslangValidator
#include "draw-vert.h"
#include "host/devices/vulkan/memory.h"

namespace tessera::bench {
namespace {

using devices::vulkan::Block;
using devices::vulkan::Machine;
using devices::vulkan::Residence;
using devices::vulkan::translated;

constexpr vk::Format kIdFormat = vk::Format::eR32Uint, kDepthFormat = vk::Format::eD32Sfloat;

/// A device-local image of one colour or depth value a pixel, rendered to and copied from.
struct Target {
  vk::raii::Image image = nullptr;
  vk::raii::DeviceMemory memory = nullptr;
  vk::raii::ImageView view = nullptr;
  std::shared_ptr<Block> copy;  // what the host reads

  Target(const std::shared_ptr<Machine>& machine, vk::Format format, vk::ImageUsageFlags usage,
         vk::ImageAspectFlags aspect, vk::Extent2D size) {
    const auto& device = machine->device;
    image = {device, vk::ImageCreateInfo({}, vk::ImageType::e2D, format, {size.width, size.height, 1}, 1, 1,
                                         vk::SampleCountFlagBits::e1, vk::ImageTiling::eOptimal,
                                         usage | vk::ImageUsageFlagBits::eTransferSrc)};
    const auto needs = image.getMemoryRequirements();
    const int type = machine->memoryType(needs.memoryTypeBits, vk::MemoryPropertyFlagBits::eDeviceLocal);
    memory = {device, vk::MemoryAllocateInfo(needs.size, static_cast<std::uint32_t>(type))};
    image.bindMemory(*memory, 0);
    view = {device, vk::ImageViewCreateInfo({}, *image, vk::ImageViewType::e2D, format, {}, {aspect, 0, 1, 0, 1})};
    copy = std::make_shared<Block>(machine, std::uint64_t{4} * size.width * size.height,
                                   vk::BufferUsageFlagBits::eTransferDst, Residence::kHost, "read-back");
  }
};

vk::raii::RenderPass makeRenderPass(const vk::raii::Device& device) {
  using Layout = vk::ImageLayout;
  const auto attachment = [](vk::Format format) {
    return vk::AttachmentDescription({}, format, vk::SampleCountFlagBits::e1, vk::AttachmentLoadOp::eClear,
                                     vk::AttachmentStoreOp::eStore, vk::AttachmentLoadOp::eDontCare,
                                     vk::AttachmentStoreOp::eDontCare, Layout::eUndefined, Layout::eTransferSrcOptimal);
  };
  const std::array attachments{attachment(kIdFormat), attachment(kDepthFormat)};
  const vk::AttachmentReference id(0, Layout::eColorAttachmentOptimal);
  const vk::AttachmentReference depth(1, Layout::eDepthStencilAttachmentOptimal);
  const vk::SubpassDescription subpass({}, vk::PipelineBindPoint::eGraphics, {}, id, {}, &depth);
  using Stage = vk::PipelineStageFlagBits;
  using Access = vk::AccessFlagBits;
  const auto drawing = Stage::eColorAttachmentOutput | Stage::eEarlyFragmentTests | Stage::eLateFragmentTests;
  const auto written = Access::eColorAttachmentWrite | Access::eDepthStencilAttachmentWrite;
  const std::array dependencies{
      vk::SubpassDependency(VK_SUBPASS_EXTERNAL, 0, drawing | Stage::eTransfer, drawing,
                            written | Access::eTransferRead, written | Access::eDepthStencilAttachmentRead),
      vk::SubpassDependency(0, VK_SUBPASS_EXTERNAL, drawing, Stage::eTransfer, written, Access::eTransferRead)};
  return {device, vk::RenderPassCreateInfo({}, attachments, subpass, dependencies)};
}

vk::raii::Pipeline makePipeline(const vk::raii::Device& device, vk::PipelineLayout layout, vk::RenderPass pass,
                                vk::Extent2D size) {
  const vk::raii::ShaderModule vertex(device, vk::ShaderModuleCreateInfo({}, sizeof kDrawVert, kDrawVert));
  const vk::raii::ShaderModule fragment(device, vk::ShaderModuleCreateInfo({}, sizeof kDrawFrag, kDrawFrag));
  const std::array stages{vk::PipelineShaderStageCreateInfo({}, vk::ShaderStageFlagBits::eVertex, *vertex, "main"),
                          vk::PipelineShaderStageCreateInfo({}, vk::ShaderStageFlagBits::eFragment, *fragment, "main")};
  const vk::VertexInputBindingDescription binding(0, sizeof(glm::vec4), vk::VertexInputRate::eVertex);
  const vk::VertexInputAttributeDescription position(0, 0, vk::Format::eR32G32B32A32Sfloat, 0);
  const vk::PipelineVertexInputStateCreateInfo input({}, binding, position);
  const vk::PipelineInputAssemblyStateCreateInfo assembly({}, vk::PrimitiveTopology::eTriangleList);
  const vk::Viewport area(0, 0, static_cast<float>(size.width), static_cast<float>(size.height), 0, 1);
  const vk::Rect2D whole({0, 0}, size);
  const vk::PipelineViewportStateCreateInfo viewport({}, area, whole);
  vk::PipelineRasterizationStateCreateInfo raster;
  raster.setPolygonMode(vk::PolygonMode::eFill).setCullMode(vk::CullModeFlagBits::eNone).setLineWidth(1);
  const vk::PipelineMultisampleStateCreateInfo samples({}, vk::SampleCountFlagBits::e1);
  const vk::PipelineDepthStencilStateCreateInfo depth({}, VK_TRUE, VK_TRUE, vk::CompareOp::eLess);
  const vk::PipelineColorBlendAttachmentState written(VK_FALSE, {}, {}, {}, {}, {}, {}, vk::ColorComponentFlagBits::eR);
  const vk::PipelineColorBlendStateCreateInfo blend({}, VK_FALSE, {}, written);
  const vk::GraphicsPipelineCreateInfo info({}, stages, &input, &assembly, nullptr, &viewport, &raster, &samples,
                                            &depth, &blend, nullptr, layout, pass);
  return {device, nullptr, info};
}

void checkDrawable(const Scene& scene, const devices::vulkan::Adapter& adapter) {
  const auto& limits = adapter.properties.limits;
  if (!adapter.features.geometryShader)
    failUnsupported(fmt::format("draw baseline: {} has no gl_PrimitiveID in fragment shaders", adapter.name()));
  if (scene.width > limits.maxFramebufferWidth || scene.height > limits.maxFramebufferHeight)
    failUnsupported(fmt::format("draw baseline: {} x {} pixels, {} draws at most {} x {}", scene.width, scene.height,
                                adapter.name(), limits.maxFramebufferWidth, limits.maxFramebufferHeight));
  for (std::size_t i = 0; i < scene.triangles.size(); ++i)
    for (std::uint32_t index : scene.triangles[i])
      if (index >= scene.vertexCount())
        failUsage(fmt::format("draw baseline: triangle {} has index {}, there are {} vertices", i, index,
                              scene.vertexCount()));
}

}  // namespace

struct DrawBaseline::State {
  std::shared_ptr<Machine> machine;
  vk::Extent2D size;
  std::uint32_t indices;
  std::unique_ptr<Block> vertexData, indexData;
  Target ids, depths;
  vk::raii::RenderPass pass;
  vk::raii::Framebuffer framebuffer;
  vk::raii::PipelineLayout layout;
  vk::raii::Pipeline pipeline;
  vk::raii::Queue queue;
  vk::raii::CommandPool pool;
  vk::raii::Fence fence;
  vk::raii::QueryPool timestamps;
  bool drawn = false;

  State(const Scene& scene, std::shared_ptr<Machine> given)
      : machine(std::move(given)),
        size(scene.width, scene.height),
        indices(static_cast<std::uint32_t>(3 * scene.triangles.size())),
        ids(machine, kIdFormat, vk::ImageUsageFlagBits::eColorAttachment, vk::ImageAspectFlagBits::eColor, size),
        depths(machine, kDepthFormat, vk::ImageUsageFlagBits::eDepthStencilAttachment, vk::ImageAspectFlagBits::eDepth,
               size),
        pass(makeRenderPass(machine->device)),
        framebuffer(makeFramebuffer()),
        layout(machine->device, vk::PipelineLayoutCreateInfo()),
        pipeline(makePipeline(machine->device, *layout, *pass, size)),
        queue(machine->device, machine->adapter.queueFamily, 0),
        pool(machine->device, {{}, machine->adapter.queueFamily}),
        fence(machine->device, vk::FenceCreateInfo()),
        timestamps(machine->device, {{}, vk::QueryType::eTimestamp, 2}) {
    const auto clip = oracle::transform(scene);
    vertexData = upload(clip.data(), clip.size() * sizeof clip[0], vk::BufferUsageFlagBits::eVertexBuffer);
    indexData = upload(scene.triangles.data(), std::size_t{indices} * 4, vk::BufferUsageFlagBits::eIndexBuffer);
  }

  vk::raii::Framebuffer makeFramebuffer() const {
    const std::array views{*ids.view, *depths.view};
    return {machine->device, vk::FramebufferCreateInfo({}, *pass, views, size.width, size.height, 1)};
  }

  /// Records with `record`, runs it and waits.
  template <class Record>
  void run(Record&& record) {
    vk::raii::CommandBuffers buffers(machine->device, {*pool, vk::CommandBufferLevel::ePrimary, 1});
    const auto& commands = buffers.front();
    commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    record(commands);
    commands.end();
    queue.submit(vk::SubmitInfo({}, {}, *commands), *fence);
    if (machine->device.waitForFences(*fence, VK_TRUE, ~0ull) != vk::Result::eSuccess)
      fail("draw baseline: the device did not finish");
    machine->device.resetFences(*fence);
  }

  std::unique_ptr<Block> upload(const void* data, std::size_t bytes, vk::BufferUsageFlags usage) {
    constexpr std::size_t kSmallest = 4;  // an empty mesh has buffers too
    Block staging(machine, std::max(bytes, kSmallest), vk::BufferUsageFlagBits::eTransferSrc, Residence::kHost,
                  "upload");
    auto block = std::make_unique<Block>(machine, staging.bytes(), usage | vk::BufferUsageFlagBits::eTransferDst,
                                         Residence::kDevice, "vertices or indices");
    if (bytes > 0) std::memcpy(staging.mapped(), data, bytes);
    run([&](const auto& commands) {
      commands.copyBuffer(staging.handle(), block->handle(), vk::BufferCopy(0, 0, staging.bytes()));
    });
    return block;
  }

  void recordDraw(const vk::raii::CommandBuffer& commands) const {
    const std::array clears{vk::ClearValue(vk::ClearColorValue(std::array{kNoTriangle, 0u, 0u, 0u})),
                            vk::ClearValue(vk::ClearDepthStencilValue(1.0f, 0))};
    commands.resetQueryPool(*timestamps, 0, 2);
    commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *timestamps, 0);
    commands.beginRenderPass({*pass, *framebuffer, {{0, 0}, size}, clears}, vk::SubpassContents::eInline);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline);
    commands.bindVertexBuffers(0, vertexData->handle(), vk::DeviceSize{0});
    commands.bindIndexBuffer(indexData->handle(), 0, vk::IndexType::eUint32);
    commands.drawIndexed(indices, 1, 0, 0, 0);
    commands.endRenderPass();
    commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *timestamps, 1);
  }

  void recordCopies(const vk::raii::CommandBuffer& commands) const {
    const auto copy = [&](const Target& from, vk::ImageAspectFlags aspect) {
      const vk::BufferImageCopy whole(0, 0, 0, {aspect, 0, 0, 1}, {0, 0, 0}, {size.width, size.height, 1});
      commands.copyImageToBuffer(*from.image, vk::ImageLayout::eTransferSrcOptimal, from.copy->handle(), whole);
    };
    copy(ids, vk::ImageAspectFlagBits::eColor);
    copy(depths, vk::ImageAspectFlagBits::eDepth);
    const vk::MemoryBarrier toHost(vk::AccessFlagBits::eTransferWrite, vk::AccessFlagBits::eHostRead);
    commands.pipelineBarrier(vk::PipelineStageFlagBits::eTransfer, vk::PipelineStageFlagBits::eHost, {}, toHost, {},
                             {});
  }
};

DrawBaseline::DrawBaseline(const Scene& scene, const std::string& select, bool validation) {
  VulkanOptions options;
  options.select = select;
  options.validation = validation;
  auto machine = std::make_shared<Machine>(options, vk::QueueFlagBits::eGraphics);
  checkDrawable(scene, machine->adapter);
  translated("draw baseline", [&] { state_ = std::make_unique<State>(scene, std::move(machine)); });
}

DrawBaseline::~DrawBaseline() = default;

std::string DrawBaseline::device() const { return state_->machine->adapter.name(); }

DrawTime DrawBaseline::time() {
  return translated("draw baseline", [&] {
    const auto begin = std::chrono::steady_clock::now();
    state_->run([&](const auto& commands) { state_->recordDraw(commands); });
    const auto wall = std::chrono::steady_clock::now() - begin;
    const auto ticks =
        state_->timestamps
            .getResults<std::uint64_t>(0, 2, 16, 8, vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait)
            .second;
    const double period = state_->machine->adapter.properties.limits.timestampPeriod;
    state_->drawn = true;
    return DrawTime{static_cast<std::uint64_t>(static_cast<double>(ticks[1] - ticks[0]) * period),
                    static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(wall).count())};
  });
}

Framebuffer DrawBaseline::framebuffer() {
  if (!state_->drawn) time();
  return translated("draw baseline", [&] {
    state_->run([&](const auto& commands) { state_->recordCopies(commands); });
    Framebuffer frame;
    frame.width = state_->size.width;
    frame.height = state_->size.height;
    frame.ids.resize(frame.pixels());
    frame.depth.resize(frame.pixels());
    std::memcpy(frame.ids.data(), state_->ids.copy->mapped(), frame.pixels() * 4);
    std::memcpy(frame.depth.data(), state_->depths.copy->mapped(), frame.pixels() * 4);
    return frame;
  });
}

}  // namespace tessera::bench
