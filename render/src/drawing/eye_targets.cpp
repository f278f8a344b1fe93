// SPDX-License-Identifier: Apache-2.0
#include "drawing/eye_targets.h"

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

#include "device/barriers.h"
#include "device/pipelines.h"
#include "drawing/pixel_tiles.h"

namespace afm::render {
namespace {

// a resolve also writes depth in the stage and with the access of colour
constexpr ImageUse kDepthResolved{vk::PipelineStageFlagBits2::eColorAttachmentOutput,
                                  vk::AccessFlagBits2::eColorAttachmentWrite, vk::ImageLayout::eDepthAttachmentOptimal};

// Use of the eyes' colour and depth between frames: composed, measured or copied.
constexpr ImageUse kEyesRead{vk::PipelineStageFlagBits2::eFragmentShader | vk::PipelineStageFlagBits2::eCopy,
                             vk::AccessFlagBits2::eShaderSampledRead | vk::AccessFlagBits2::eTransferRead,
                             vk::ImageLayout::eShaderReadOnlyOptimal};

// Limit: objects may extend this many half screens beyond the screen's centre.
constexpr float kLargestGuardBand = 8.0F;

// Redirects the attachment to a multisampled image that is resolved into the original one.
void resolve(vk::RenderingAttachmentInfo& attachment, vk::ImageView multisampled, vk::ResolveModeFlagBits mode) {
  attachment.resolveImageView = std::exchange(attachment.imageView, multisampled);
  attachment.resolveImageLayout = attachment.imageLayout;
  attachment.resolveMode = mode;
}

}  // namespace

EyeTargets::EyeTargets(const Device& device, const RendererOptions& options)
    : device_(&device),
      extent_{options.eye_width, options.eye_height},
      plain_background_(options.lighting == Lighting::KeyAlone),
      color_(create_target("eyes", kEyeFormat, 2)),
      depth_(create_target("eyes depth", kDepthFormat, 2)) {
  const auto largest = device.physical().getProperties().limits.maxViewportDimensions;
  guard_band_ = std::min({kLargestGuardBand, static_cast<float>(largest[0]) / static_cast<float>(extent_.width),
                          static_cast<float>(largest[1]) / static_cast<float>(extent_.height)});
}

EyeTargets::Target EyeTargets::create_target(const char* name, vk::Format format, std::uint32_t layers) const {
  using Usage = vk::ImageUsageFlagBits;
  const bool is_depth = format == kDepthFormat;
  const auto aspect = is_depth ? kDepthAspect : kColorAspect;
  Target target;
  target.image = create_image(*device_, name,
                              {.format = format,
                               .extent = extent_,
                               .usage = (is_depth ? Usage::eDepthStencilAttachment : Usage::eColorAttachment) |
                                        Usage::eSampled | Usage::eTransferSrc | Usage::eTransferDst,
                               .layers = layers,
                               .seen_as = is_depth ? vk::Format::eUndefined : kEyeLinearFormat});
  target.both = create_view(*device_, target.image, aspect, 0, layers);
  for (std::uint32_t layer = 0; layer < layers; ++layer) {
    target.single.push_back(create_view(*device_, target.image, aspect, layer, 1));
  }
  if (!is_depth) target.linear = create_view(*device_, target.image, aspect, 0, layers, kEyeLinearFormat);
  return target;
}

EyeTargets::Multisampled EyeTargets::create_multisampled(std::uint32_t layers) const {
  using Usage = vk::ImageUsageFlagBits;
  ImageRequest request{.format = kEyeFormat,
                       .extent = extent_,
                       .usage = Usage::eColorAttachment,
                       .layers = layers,
                       .samples = drawing_.samples};
  Multisampled made;
  made.color = create_image(*device_, "eyes multisampled", request);
  made.color_view = create_view(*device_, made.color, kColorAspect, 0, layers);
  request.format = kDepthFormat;
  request.usage = Usage::eDepthStencilAttachment;
  made.depth = create_image(*device_, "eyes multisampled depth", request);
  made.depth_view = create_view(*device_, made.depth, kDepthAspect, 0, layers);
  return made;
}

void EyeTargets::begin_frame(const EyePassConfig& drawing) {
  drawing_ = drawing;
  const bool both = drawing.pass == EyePass::Both;
  for (std::size_t pass = 0; resolves() && pass < drawing.pass_count; ++pass) {
    Multisampled& drawn = multisampled_[both ? 0 : 1 + pass];
    if (!*drawn.color_view) drawn = create_multisampled(both ? 2 : 1);
  }
  if (resolves() && drawing.pass_count == 2 && second_color_.single.empty()) {
    second_color_ = create_target("second eye", kEyeFormat, 1);
    second_depth_ = create_target("second eye's depth", kDepthFormat, 1);
  }
  if (reduced() && reduced_color_.single.empty()) {
    reduced_color_ = create_target("reduced eyes", kEyeFormat, 2);
    enlarged_depth_ = create_target("enlarged depth", kDepthFormat, 2);
  }
}

LayerRange EyeTargets::layers_of(std::size_t pass) const {
  return drawing_.pass_count == 1 ? LayerRange{} : LayerRange{static_cast<std::uint32_t>(pass), 1};
}

EyeTargets::Filled EyeTargets::filled(std::size_t pass) const {
  const auto layer = static_cast<std::uint32_t>(pass);
  if (drawing_.pass_count == 1) {
    return {.color = drawn_color(), .depth = depth_, .layer = 0, .layers = layers_of(pass)};
  }
  if (copies(pass)) {
    return {.color = second_color_, .depth = second_depth_, .layer = 0, .layers = {}};
  }
  return {.color = drawn_color(), .depth = depth_, .layer = layer, .layers = layers_of(pass)};
}

void EyeTargets::begin(const vk::raii::CommandBuffer& command, std::size_t pass,
                       const std::optional<PixelBox>& box) const {
  const bool both = drawing_.pass == EyePass::Both;
  const Filled to = filled(pass);
  const auto held = [&](const ImageUse& use) { return box ? use : use.discarded(); };

  // a background that is drawn covers every pixel left over, so the colour needs no clearing; for a partial redraw,
  // neither does the depth
  const auto uncovered = plain_background_ ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eDontCare;
  vk::RenderingAttachmentInfo color{.imageView = both ? *to.color.both : *to.color.single[to.layer],
                                    .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
                                    .loadOp = box ? vk::AttachmentLoadOp::eLoad : uncovered,
                                    .storeOp = vk::AttachmentStoreOp::eStore,
                                    .clearValue = kPlainBackground};
  vk::RenderingAttachmentInfo depth{.imageView = both ? *to.depth.both : *to.depth.single[to.layer],
                                    .imageLayout = vk::ImageLayout::eDepthAttachmentOptimal,
                                    .loadOp = box ? vk::AttachmentLoadOp::eLoad : vk::AttachmentLoadOp::eClear,
                                    .storeOp = vk::AttachmentStoreOp::eStore,
                                    .clearValue = vk::ClearDepthStencilValue{.depth = 0.0F}};
  record_barriers(command, {image_barrier(*to.color.image.image, kColorAspect, held(kEyesRead), kColorDrawn, to.layers),
                            image_barrier(*to.depth.image.image, kDepthAspect, held(kEyesRead),
                                          resolves() ? kDepthResolved : kDepthTested, to.layers)});
  if (resolves()) {
    const Multisampled& drawn = multisampled(pass);
    record_barriers(command, {image_barrier(*drawn.color.image, kColorAspect, held(kColorDrawn), kColorDrawn),
                              image_barrier(*drawn.depth.image, kDepthAspect, held(kDepthTested), kDepthTested)});
    resolve(color, *drawn.color_view, vk::ResolveModeFlagBits::eAverage);
    resolve(depth, *drawn.depth_view, vk::ResolveModeFlagBits::eSampleZero);
  }
  const vk::Rect2D area = box.value_or(PixelBox::whole(drawing_.extent)).rect();
  command.beginRendering({.renderArea = area,
                          .layerCount = 1,
                          .viewMask = both ? kBothEyes : 0U,
                          .colorAttachmentCount = 1,
                          .pColorAttachments = &color,
                          .pDepthAttachment = &depth});
  set_viewport(command, drawing_.extent, guard_band_);
  command.setScissor(0, area);
}

void EyeTargets::end(const vk::raii::CommandBuffer& command, std::size_t pass,
                     const std::optional<PixelBox>& box) const {
  const Filled to = filled(pass);
  command.endRendering();
  record_barriers(command, {image_barrier(*to.color.image.image, kColorAspect, kColorDrawn, kEyesRead, to.layers),
                            image_barrier(*to.depth.image.image, kDepthAspect,
                                          resolves() ? kDepthResolved : kDepthTested, kEyesRead, to.layers)});
  if (copies(pass)) {
    copy_second(command, box.value_or(PixelBox::whole(drawing_.extent)));
  }
}

void EyeTargets::copy_second(const vk::raii::CommandBuffer& command, const PixelBox& box) const {
  const LayerRange second{1, 1};
  const bool whole = box == PixelBox::whole(drawing_.extent);
  const auto copy = [&](const Target& from, const Target& to, vk::ImageAspectFlags aspect) {
    record_barriers(command, {image_barrier(*from.image.image, aspect, kEyesRead, kCopiedFrom),
                              image_barrier(*to.image.image, aspect, whole ? kEyesRead.discarded() : kEyesRead,
                                            kCopiedTo, second)});
    const vk::Rect2D area = box.rect();
    const vk::Offset3D offset{area.offset.x, area.offset.y, 0};
    const vk::ImageCopy region{.srcSubresource = {.aspectMask = aspect, .baseArrayLayer = 0, .layerCount = 1},
                               .srcOffset = offset,
                               .dstSubresource = {.aspectMask = aspect, .baseArrayLayer = 1, .layerCount = 1},
                               .dstOffset = offset,
                               .extent = {area.extent.width, area.extent.height, 1}};
    command.copyImage(*from.image.image, kCopiedFrom.layout, *to.image.image, kCopiedTo.layout, region);
    record_barriers(command, {image_barrier(*from.image.image, aspect, kCopiedFrom, kEyesRead),
                              image_barrier(*to.image.image, aspect, kCopiedTo, kEyesRead, second)});
  };
  copy(second_color_, drawn_color(), kColorAspect);
  copy(second_depth_, depth_, kDepthAspect);
}

void EyeTargets::begin_enlarged(const vk::raii::CommandBuffer& command, std::size_t pass,
                                const std::optional<PixelBox>& box) const {
  const bool both = drawing_.pass == EyePass::Both;
  const LayerRange layers = layers_of(pass);
  record_barriers(
      command,
      {image_barrier(*color_.image.image, kColorAspect, box ? kEyesRead : kEyesRead.discarded(), kColorDrawn, layers),
       image_barrier(*enlarged_depth_.image.image, kDepthAspect, kDepthTested.discarded(), kDepthTested, layers)});
  const vk::RenderingAttachmentInfo color{.imageView = both ? *color_.both : *color_.single[pass],
                                          .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
                                          .loadOp = box ? vk::AttachmentLoadOp::eLoad : vk::AttachmentLoadOp::eDontCare,
                                          .storeOp = vk::AttachmentStoreOp::eStore};
  const vk::RenderingAttachmentInfo depth{.imageView = both ? *enlarged_depth_.both : *enlarged_depth_.single[pass],
                                          .imageLayout = vk::ImageLayout::eDepthAttachmentOptimal,
                                          .loadOp = vk::AttachmentLoadOp::eDontCare,
                                          .storeOp = vk::AttachmentStoreOp::eDontCare};
  command.beginRendering({.renderArea = box.value_or(PixelBox::whole(extent_)).rect(),
                          .layerCount = 1,
                          .viewMask = both ? kBothEyes : 0U,
                          .colorAttachmentCount = 1,
                          .pColorAttachments = &color,
                          .pDepthAttachment = &depth});
}

void EyeTargets::end_enlarged(const vk::raii::CommandBuffer& command, std::size_t pass) const {
  command.endRendering();
  record_barriers(command, {image_barrier(*color_.image.image, kColorAspect, kColorDrawn, kEyesRead, layers_of(pass))});
}

// Area that depends on an area of the drawn room; the enlargement blends neighbours.
PixelArea EyeTargets::enlarged(const PixelArea& drawn) const {
  if (!reduced() || drawn.everything()) return drawn;
  const glm::dvec2 scale(static_cast<double>(extent_.width) / drawing_.extent.width,
                         static_cast<double>(extent_.height) / drawing_.extent.height);
  PixelTiles tiles(extent_);
  for (const PixelBox& box : drawn.boxes()) {
    const glm::ivec2 low(glm::floor(scale * glm::dvec2(box.low - 1)));
    const glm::ivec2 high(glm::ceil(scale * glm::dvec2(box.high + 1)));
    tiles.add(PixelBox{low, high}.within(PixelBox::whole(extent_)));
  }
  return tiles.area();
}

void EyeTargets::begin_copies(const vk::raii::CommandBuffer& command) const {
  record_barriers(command, {image_barrier(*color_.image.image, kColorAspect, kEyesRead, kCopiedFrom)});
}

void EyeTargets::copy(const vk::raii::CommandBuffer& command, scene::Eye eye, const PixelBox& box, vk::Image to,
                      std::uint32_t to_layer, vk::Offset2D place) const {
  const vk::Rect2D area = box.rect();
  const vk::ImageCopy region{
      .srcSubresource = {.aspectMask = kColorAspect, .baseArrayLayer = layer(eye), .layerCount = 1},
      .srcOffset = {area.offset.x, area.offset.y, 0},
      .dstSubresource = {.aspectMask = kColorAspect, .baseArrayLayer = to_layer, .layerCount = 1},
      .dstOffset = {place.x + area.offset.x, place.y + area.offset.y, 0},
      .extent = {area.extent.width, area.extent.height, 1}};
  command.copyImage(*color_.image.image, kCopiedFrom.layout, to, vk::ImageLayout::eTransferDstOptimal, region);
}

void EyeTargets::end_copies(const vk::raii::CommandBuffer& command) const {
  record_barriers(command, {image_barrier(*color_.image.image, kColorAspect, kCopiedFrom, kEyesRead)});
}

void EyeTargets::copy_depth(const vk::raii::CommandBuffer& command, scene::Eye eye, vk::Image to,
                            std::uint32_t to_layer) const {
  const LayerRange from{layer(eye), 1};
  const vk::ImageCopy region{
      .srcSubresource = {.aspectMask = kDepthAspect, .baseArrayLayer = from.first, .layerCount = 1},
      .dstSubresource = {.aspectMask = kDepthAspect, .baseArrayLayer = to_layer, .layerCount = 1},
      .extent = {drawing_.extent.width, drawing_.extent.height, 1}};
  const vk::Image image = *depth_.image.image;
  record_barriers(command, {image_barrier(image, kDepthAspect, kEyesRead, kCopiedFrom, from)});
  command.copyImage(image, kCopiedFrom.layout, to, kCopiedTo.layout, region);
  record_barriers(command, {image_barrier(image, kDepthAspect, kCopiedFrom, kEyesRead, from)});
}

EyeTargets::EyeImage EyeTargets::eye(scene::Eye eye) const {
  return {.image = *color_.image.image, .layer = layer(eye)};
}

}  // namespace afm::render
