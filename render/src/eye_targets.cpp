// SPDX-License-Identifier: Apache-2.0
#include "eye_targets.h"

#include <algorithm>
#include <utility>

#include "barriers.h"
#include "pipelines.h"

namespace afm::render {
namespace {

constexpr ImageUse kColorWritten{vk::PipelineStageFlagBits2::eColorAttachmentOutput,
                                 vk::AccessFlagBits2::eColorAttachmentWrite, vk::ImageLayout::eColorAttachmentOptimal};
constexpr ImageUse kDepthTested{
    vk::PipelineStageFlagBits2::eEarlyFragmentTests | vk::PipelineStageFlagBits2::eLateFragmentTests,
    vk::AccessFlagBits2::eDepthStencilAttachmentRead | vk::AccessFlagBits2::eDepthStencilAttachmentWrite,
    vk::ImageLayout::eDepthAttachmentOptimal};
// a resolve writes depth, too, in the stage and with the access of colour
constexpr ImageUse kDepthResolved{vk::PipelineStageFlagBits2::eColorAttachmentOutput,
                                  vk::AccessFlagBits2::eColorAttachmentWrite, vk::ImageLayout::eDepthAttachmentOptimal};

// The eyes' colour and depth between frames: composed, measured or copied by whoever asks.
constexpr ImageUse kColorRead{vk::PipelineStageFlagBits2::eFragmentShader | vk::PipelineStageFlagBits2::eCopy,
                              vk::AccessFlagBits2::eShaderSampledRead | vk::AccessFlagBits2::eTransferRead,
                              vk::ImageLayout::eShaderReadOnlyOptimal};
constexpr ImageUse kDepthRead = kColorRead;

constexpr auto kColor = vk::ImageAspectFlagBits::eColor;
constexpr auto kDepth = vk::ImageAspectFlagBits::eDepth;

// Objects may reach this many half screens beyond the screen's middle.
constexpr float kLargestGuardBand = 8.0F;

// The attachment is drawn with many samples, and what it held goes, with one, to where it pointed before.
void resolve(vk::RenderingAttachmentInfo& attachment, vk::ImageView multisampled, vk::ResolveModeFlagBits mode) {
  attachment.resolveImageView = std::exchange(attachment.imageView, multisampled);
  attachment.resolveImageLayout = attachment.imageLayout;
  attachment.resolveMode = mode;
  attachment.storeOp = vk::AttachmentStoreOp::eDontCare;
}

}  // namespace

EyeTargets::EyeTargets(const Device& device, const RendererOptions& options)
    : extent_{options.eye_width, options.eye_height},
      samples_(options.samples == 4 ? vk::SampleCountFlagBits::e4 : vk::SampleCountFlagBits::e1) {
  const auto largest = device.physical().getProperties().limits.maxViewportDimensions;
  guard_band_ = std::min({kLargestGuardBand, static_cast<float>(largest[0]) / static_cast<float>(extent_.width),
                          static_cast<float>(largest[1]) / static_cast<float>(extent_.height)});
  if (options.pass_mode == PassMode::Multiview) {
    sets_.push_back(create_set(device, 2));
  } else {
    sets_.push_back(create_set(device, 1));
    sets_.push_back(create_set(device, 1));
  }
}

EyeTargets::Set EyeTargets::create_set(const Device& device, std::uint32_t layers) const {
  using Usage = vk::ImageUsageFlagBits;
  Set set;
  if (samples_ != vk::SampleCountFlagBits::e1) {
    set.multisampled = create_image(device, "eyes multisampled",
                                    {.format = kEyeFormat,
                                     .extent = extent_,
                                     .usage = Usage::eColorAttachment | Usage::eTransientAttachment,
                                     .layers = layers,
                                     .samples = samples_});
    set.multisampled_view = create_view(device, set.multisampled, kColor, 0, layers);
    set.multisampled_depth = create_image(device, "eyes multisampled depth",
                                          {.format = kDepthFormat,
                                           .extent = extent_,
                                           .usage = Usage::eDepthStencilAttachment | Usage::eTransientAttachment,
                                           .layers = layers,
                                           .samples = samples_});
    set.multisampled_depth_view = create_view(device, set.multisampled_depth, kDepth, 0, layers);
  }
  set.depth = create_image(device, "eyes depth",
                           {.format = kDepthFormat,
                            .extent = extent_,
                            .usage = Usage::eDepthStencilAttachment | Usage::eSampled | Usage::eTransferSrc,
                            .layers = layers});
  set.depth_view = create_view(device, set.depth, kDepth, 0, layers);
  set.resolved = create_image(device, "eyes",
                              {.format = kEyeFormat,
                               .extent = extent_,
                               .usage = Usage::eColorAttachment | Usage::eSampled | Usage::eTransferSrc,
                               .layers = layers});
  set.resolved_view = create_view(device, set.resolved, kColor, 0, layers);
  for (std::uint32_t layer = 0; layer < layers; ++layer) {
    set.eye_views.push_back(create_view(device, set.resolved, kColor, layer, 1));
    set.eye_depth_views.push_back(create_view(device, set.depth, kDepth, layer, 1));
  }
  return set;
}

void EyeTargets::begin(const vk::raii::CommandBuffer& command, std::size_t pass) const {
  const Set& set = sets_[pass];
  // the background covers every pixel that nothing else does, so no colour needs to be cleared
  vk::RenderingAttachmentInfo color{.imageView = *set.resolved_view,
                                    .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
                                    .loadOp = vk::AttachmentLoadOp::eDontCare,
                                    .storeOp = vk::AttachmentStoreOp::eStore};
  vk::RenderingAttachmentInfo depth{.imageView = *set.depth_view,
                                    .imageLayout = vk::ImageLayout::eDepthAttachmentOptimal,
                                    .loadOp = vk::AttachmentLoadOp::eClear,
                                    .storeOp = vk::AttachmentStoreOp::eStore,
                                    .clearValue = vk::ClearDepthStencilValue{.depth = 0.0F}};
  if (samples_ == vk::SampleCountFlagBits::e1) {
    record_barriers(command, {image_barrier(*set.resolved.image, kColor, kColorRead.discarded(), kColorWritten),
                              image_barrier(*set.depth.image, kDepth, kDepthRead.discarded(), kDepthTested)});
  } else {
    record_barriers(command,
                    {image_barrier(*set.resolved.image, kColor, kColorRead.discarded(), kColorWritten),
                     image_barrier(*set.depth.image, kDepth, kDepthRead.discarded(), kDepthResolved),
                     image_barrier(*set.multisampled.image, kColor, kColorWritten.discarded(), kColorWritten),
                     image_barrier(*set.multisampled_depth.image, kDepth, kDepthTested.discarded(), kDepthTested)});
    resolve(color, *set.multisampled_view, vk::ResolveModeFlagBits::eAverage);
    resolve(depth, *set.multisampled_depth_view, vk::ResolveModeFlagBits::eSampleZero);
  }
  command.beginRendering({.renderArea = {.extent = extent_},
                          .layerCount = 1,
                          .viewMask = view_mask(),
                          .colorAttachmentCount = 1,
                          .pColorAttachments = &color,
                          .pDepthAttachment = &depth});
  set_viewport(command, extent_, guard_band_);
}

void EyeTargets::end(const vk::raii::CommandBuffer& command, std::size_t pass) const {
  const Set& set = sets_[pass];
  command.endRendering();
  record_barriers(command,
                  {image_barrier(*set.resolved.image, kColor, kColorWritten, kColorRead),
                   image_barrier(*set.depth.image, kDepth,
                                 samples_ == vk::SampleCountFlagBits::e1 ? kDepthTested : kDepthResolved, kDepthRead)});
}

EyeTargets::Place EyeTargets::place(scene::Eye eye) const {
  const std::uint32_t index = eye == scene::Eye::Left ? 0 : 1;
  return sets_.size() == 1 ? Place{.set = &sets_.front(), .layer = index} : Place{.set = &sets_[index], .layer = 0};
}

EyeTargets::EyeImage EyeTargets::eye(scene::Eye eye) const {
  const auto [set, layer] = place(eye);
  return {.image = *set->resolved.image, .layer = layer, .view = *set->eye_views[layer]};
}

EyeTargets::EyeImage EyeTargets::depth(scene::Eye eye) const {
  const auto [set, layer] = place(eye);
  return {.image = *set->depth.image, .layer = layer, .view = *set->eye_depth_views[layer]};
}

}  // namespace afm::render
