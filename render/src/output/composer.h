// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "device/barriers.h"
#include "device/shader_interface.h"
#include "output/corrections.h"
#include "passes/damage.h"
#include "passes/eye_targets.h"
#include "render/composition.h"
#include "render/frame.h"
#include "render/renderer.h"

namespace afm::render {

// Target area of a picture.
struct ComposePlace {
  vk::Extent2D target;      // the whole image
  vk::Rect2D area;          // what the picture fills
  glm::ivec2 screen_px{0};  // where the target's first pixel lies on its screen

  bool operator==(const ComposePlace&) const = default;
};

// What an image of the target shows, so that the next picture changes only what differs from it.
struct ComposedPicture {
  Composition composition;
  ComposePlace place;
  std::uint64_t eye_changes = 0;  // EyeChanges::count() of the eyes in it
};

// Target of a composition: an image with one layer for each picture of the mode.
struct ComposeInto {
  vk::Image image;
  std::span<const vk::ImageView> layers;  // views of single layers
  ImageUse before;                        // what last used the image; its layout is that of `after`
  ImageUse after;                         // how the image is left
  bool takes_copies = false;              // it has the eyes' format, and may be copied to
  std::optional<ComposedPicture>* shown;  // nothing before the first picture
};

// An image that pictures are composed into to be read, with as many layers as the mode has pictures.
struct ComposeTarget {
  DeviceImage image;
  std::array<vk::raii::ImageView, 2> views{nullptr, nullptr};  // of each layer alone
  std::optional<ComposedPicture> shown;
};

// Composes into images of one format: one pipeline for each kind of picture, created at first use.
class ComposePipeline {
 public:
  // `layout` must outlive it.
  ComposePipeline(const Device& device, vk::PipelineLayout layout, vk::Format format);

  // `variant`: of AFM_FEATURE_SCALED, _MIXED, _WARPED and _BLENDED.
  vk::Pipeline get(std::uint32_t variant);

 private:
  const Device* device_;
  vk::PipelineLayout layout_;
  vk::Format format_;
  std::vector<vk::raii::Pipeline> made_;  // AFM_COMPOSE_VARIANTS
};

// Puts the two eye images into one picture: byte for byte where it is drawn at its own size. Every stereo mode is a
// mode of one full-screen shader.
class Composer {
 public:
  // `changes` are those of `eyes`; both must outlive it.
  Composer(const Device& device, const EyeTargets& eyes, const EyeChanges& changes);

  // The picture, or both, of the eyes' newest contents; waits for it. The device can make an image of that size.
  std::vector<Image> compose(const Composition& composition, const ReadArea& area);

  // To be called when the eye images have been made anew and nothing is in flight.
  void eyes_changed();

  // The picture's own size.
  vk::Extent2D extent(scene::StereoMode mode) const;

  // For targets of another format than the eyes'.
  ComposePipeline create_pipeline_for(vk::Format format) const { return {device_, *layout_, format}; }

  // Draws the picture, or each of two into its layer, scaled to fill its area and black around it: into what a window
  // shows and into what is read alike. Where the picture is nothing but the eyes' images beside each other, these are
  // copied: on a CPU device that takes a fifth of the time. Of a picture that the image already shows with older eyes,
  // only what has changed is drawn.
  void record(const vk::raii::CommandBuffer& command, ComposePipeline& pipeline, const Composition& composition,
              const ComposePlace& place, const ComposeInto& into);

  // Draws what is read into `target`, which nothing in flight uses and which is made anew if it is not of that size,
  // and leaves it in eTransferSrcOptimal.
  void record(const vk::raii::CommandBuffer& command, const Composition& composition, const ReadArea& area,
              ComposeTarget& target);

 private:
  // What one picture is drawn with.
  struct Drawn {
    const Composition& composition;
    const ComposePlace& place;
    const Correction& correction;
  };
  PixelArea changed_in(const ComposeInto& into, const Drawn& drawn) const;
  void draw(const vk::raii::CommandBuffer& command, vk::Pipeline pipeline, const Drawn& drawn, const vk::Rect2D& part,
            std::uint32_t layer) const;
  void draw_parts(const vk::raii::CommandBuffer& command, ComposePipeline& pipeline, const Drawn& drawn,
                  const ComposeInto& into, const PixelArea& changed) const;
  void copy(const vk::raii::CommandBuffer& command, const Composition& composition, const ComposeInto& into,
            const PixelBox& box) const;
  void copy_parts(const vk::raii::CommandBuffer& command, const Composition& composition, const ComposeInto& into,
                  const PixelArea& changed) const;

  const Device& device_;
  const EyeTargets& eyes_;
  const EyeChanges& changes_;
  Corrections corrections_;
  vk::raii::DescriptorSetLayout set_layout_;
  vk::raii::PipelineLayout layout_;
  ComposePipeline pipeline_;
  vk::raii::Sampler sampler_;
  Buffer anaglyphs_;
  vk::raii::DescriptorPool pool_;
  vk::raii::DescriptorSet set_{nullptr};
  ComposeTarget target_;  // of compose()
};

}  // namespace afm::render
