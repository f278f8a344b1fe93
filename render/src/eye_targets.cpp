// SPDX-License-Identifier: Apache-2.0
#include "eye_targets.h"

#include <algorithm>

#include "barriers.h"
#include "pipelines.h"

namespace afm::render {
namespace {

constexpr ImageUse kColorWritten{vk::PipelineStageFlagBits2::eColorAttachmentOutput,
                                 vk::AccessFlagBits2::eColorAttachmentWrite, vk::ImageLayout::eColorAttachmentOptimal};
constexpr ImageUse kColorDiscarded{vk::PipelineStageFlagBits2::eColorAttachmentOutput,
                                   vk::AccessFlagBits2::eColorAttachmentWrite, vk::ImageLayout::eUndefined};
constexpr ImageUse kDepthDiscarded{vk::PipelineStageFlagBits2::eLateFragmentTests,
                                   vk::AccessFlagBits2::eDepthStencilAttachmentWrite, vk::ImageLayout::eUndefined};
constexpr ImageUse kDepthTested{
    vk::PipelineStageFlagBits2::eEarlyFragmentTests | vk::PipelineStageFlagBits2::eLateFragmentTests,
    vk::AccessFlagBits2::eDepthStencilAttachmentRead | vk::AccessFlagBits2::eDepthStencilAttachmentWrite,
    vk::ImageLayout::eDepthAttachmentOptimal};

// The eye images between frames: composed or copied by whoever asks.
constexpr ImageUse kEyesRead{vk::PipelineStageFlagBits2::eFragmentShader | vk::PipelineStageFlagBits2::eCopy,
                             vk::AccessFlagBits2::eShaderSampledRead | vk::AccessFlagBits2::eTransferRead,
                             vk::ImageLayout::eShaderReadOnlyOptimal};
constexpr ImageUse kEyesDiscarded{vk::PipelineStageFlagBits2::eFragmentShader | vk::PipelineStageFlagBits2::eCopy,
                                  vk::AccessFlagBits2::eNone, vk::ImageLayout::eUndefined};

constexpr auto kColor = vk::ImageAspectFlagBits::eColor;
// Objects may reach this many half screens beyond the screen's middle.
constexpr float kLargestGuardBand = 8.0F;

constexpr auto kDepth = vk::ImageAspectFlagBits::eDepth;

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
  }
  set.depth = create_image(device, "eyes depth",
                           {.format = kDepthFormat,
                            .extent = extent_,
                            .usage = Usage::eDepthStencilAttachment | Usage::eTransientAttachment,
                            .layers = layers,
                            .samples = samples_});
  set.depth_view = create_view(device, set.depth, kDepth, 0, layers);
  set.resolved = create_image(device, "eyes",
                              {.format = kEyeFormat,
                               .extent = extent_,
                               .usage = Usage::eColorAttachment | Usage::eSampled | Usage::eTransferSrc,
                               .layers = layers});
  set.resolved_view = create_view(device, set.resolved, kColor, 0, layers);
  for (std::uint32_t layer = 0; layer < layers; ++layer) {
    set.eye_views.push_back(create_view(device, set.resolved, kColor, layer, 1));
  }
  return set;
}

void EyeTargets::begin(const vk::raii::CommandBuffer& command, std::size_t pass) const {
  const Set& set = sets_[pass];
  const bool resolve = samples_ != vk::SampleCountFlagBits::e1;
  record_barriers(command, {image_barrier(*set.resolved.image, kColor, kEyesDiscarded, kColorWritten),
                            image_barrier(*set.depth.image, kDepth, kDepthDiscarded, kDepthTested)});
  if (resolve) {
    record_barriers(command, {image_barrier(*set.multisampled.image, kColor, kColorDiscarded, kColorWritten)});
  }

  // the background covers every pixel that nothing else does, so no colour needs to be cleared
  vk::RenderingAttachmentInfo color{.imageView = *set.resolved_view,
                                    .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
                                    .loadOp = vk::AttachmentLoadOp::eDontCare,
                                    .storeOp = vk::AttachmentStoreOp::eStore};
  if (resolve) {
    color.imageView = *set.multisampled_view;
    color.storeOp = vk::AttachmentStoreOp::eDontCare;
    color.resolveMode = vk::ResolveModeFlagBits::eAverage;
    color.resolveImageView = *set.resolved_view;
    color.resolveImageLayout = vk::ImageLayout::eColorAttachmentOptimal;
  }
  const vk::RenderingAttachmentInfo depth{.imageView = *set.depth_view,
                                          .imageLayout = vk::ImageLayout::eDepthAttachmentOptimal,
                                          .loadOp = vk::AttachmentLoadOp::eClear,
                                          .storeOp = vk::AttachmentStoreOp::eDontCare,
                                          .clearValue = vk::ClearDepthStencilValue{.depth = 0.0F}};
  command.beginRendering({.renderArea = {.extent = extent_},
                          .layerCount = 1,
                          .viewMask = view_mask(),
                          .colorAttachmentCount = 1,
                          .pColorAttachments = &color,
                          .pDepthAttachment = &depth});
  set_viewport(command, extent_, guard_band_);
}

void EyeTargets::end(const vk::raii::CommandBuffer& command, std::size_t pass) const {
  command.endRendering();
  record_barriers(command, {image_barrier(*sets_[pass].resolved.image, kColor, kColorWritten, kEyesRead)});
}

EyeTargets::EyeImage EyeTargets::eye(scene::Eye eye) const {
  const std::size_t index = eye == scene::Eye::Left ? 0 : 1;
  const std::size_t set = sets_.size() == 1 ? 0 : index;
  const std::size_t layer = sets_.size() == 1 ? index : 0;
  return {.image = *sets_[set].resolved.image,
          .layer = static_cast<std::uint32_t>(layer),
          .view = *sets_[set].eye_views[layer]};
}

}  // namespace afm::render
