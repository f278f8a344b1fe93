// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "composition/corrections.h"
#include "device/barriers.h"
#include "device/shader_interface.h"
#include "drawing/eye_targets.h"
#include "passes/damage.h"
#include "render/composition.h"
#include "render/frame.h"
#include "render/renderer.h"

namespace afm::render {

// Target area of a picture.
struct ComposePlace {
  vk::Extent2D target;      // size of the whole image
  vk::Rect2D area;          // part covered by the picture
  glm::ivec2 screen_px{0};  // screen position of the target's first pixel

  bool operator==(const ComposePlace&) const = default;
};

// Current contents of a target image, so that the next picture redraws only the differences.
struct ComposedPicture {
  Composition composition;
  ComposePlace place;
  std::uint64_t eye_changes = 0;  // value of EyeChanges::count() at the time of drawing
};

// Target of a composition: an image with one layer per picture of the mode.
struct ComposeInto {
  vk::Image image;
  std::span<const vk::ImageView> layers;  // one view per layer
  ImageUse before;                        // previous use of the image; its layout is that of `after`
  ImageUse after;                         // state in which the image is left
  bool takes_copies = false;              // true: eyes' format, so that it accepts copies
  std::optional<ComposedPicture>* shown;  // picture in the image; empty before the first one
};

// Image that pictures are composed into for readback, with one layer per picture of the mode.
struct ComposeTarget {
  DeviceImage image;
  std::array<vk::raii::ImageView, 2> views{nullptr, nullptr};  // one per layer
  std::optional<ComposedPicture> shown;
};

// Composes into images of one format, with one pipeline per kind of picture, created at first use.
class ComposePipeline {
 public:
  // `layout` must outlive it.
  ComposePipeline(const Device& device, vk::PipelineLayout layout, vk::Format format);

  // `variant` combines AFM_FEATURE_SCALED, _MIXED, _WARPED and _BLENDED.
  vk::Pipeline get(std::uint32_t variant);

 private:
  const Device* device_;
  vk::PipelineLayout layout_;
  vk::Format format_;
  std::vector<vk::raii::Pipeline> made_;  // AFM_COMPOSE_VARIANTS entries, created at first use
};

// Combines the two eye images into one picture, byte for byte if it is drawn at its own size. One full-screen shader
// implements every stereo mode.
class Composer {
 public:
  // `changes` belongs to `eyes`; both must outlive the composer.
  Composer(const Device& device, const EyeTargets& eyes, const EyeChanges& changes);

  // Composes the eyes' newest contents into one or two pictures, and waits for them. The device must support images of
  // that size.
  std::vector<Image> compose(const Composition& composition, const ReadArea& area);

  // Call when the eye images have been recreated and nothing is in flight.
  void eyes_changed();

  // Unscaled size of the picture.
  vk::Extent2D extent(scene::StereoMode mode) const;

  // Creates a pipeline for targets in a format other than the eyes'.
  ComposePipeline create_pipeline_for(vk::Format format) const { return {device_, *layout_, format}; }

  // Draws the picture, or each of two into its layer, scaled to fill its area and surrounded by black. Windows and
  // readback use the same code. A picture that consists only of the eyes' images side by side is copied instead, which
  // takes a fifth of the time on a CPU device. If the image already shows an older version of the picture, only the
  // changes are drawn.
  void record(const vk::raii::CommandBuffer& command, ComposePipeline& pipeline, const Composition& composition,
              const ComposePlace& place, const ComposeInto& into);

  // Draws a picture for readback into `target` and leaves it in eTransferSrcOptimal. Recreates `target` if its size
  // differs; nothing in flight may use it.
  void record(const vk::raii::CommandBuffer& command, const Composition& composition, const ReadArea& area,
              ComposeTarget& target);

 private:
  // Resources for drawing one picture.
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
  ComposeTarget target_;  // images for compose()
};

}  // namespace afm::render
