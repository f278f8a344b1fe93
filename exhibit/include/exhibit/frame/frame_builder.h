// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "curves/sample_model.h"
#include "exhibit/models/relief.h"
#include "exhibit/state/moment.h"
#include "exhibit/words/phrases.h"
#include "render/frame.h"
#include "scene/display/wall.h"
#include "scene/shared/shared_blocks.h"

namespace afm::exhibit {

class WallScene;

// Phase of the cycle, with the letters of the paper's Fig. 2.
Phrase stage_of_cycle(const Moment& moment, double z_jtc_m);

// Converts moments to frames for one wall and one viewer. One thread.
class FrameBuilder {
 public:
  // `wall_scene`, whose language it uses, and `materials` must outlive the object. A material's parameters may change
  // between two frames.
  FrameBuilder(const WallScene& wall_scene, const std::vector<curves::SampleModel>& materials,
               const std::array<scene::EyeView, 2>& eyes);

  render::FrameState build(const Moment& moment) const;

 private:
  // Sample last shown in false colours.
  struct ColouredSample {
    std::size_t material = 0;
    double release_z_m = 0;  // size of the sample, as in WallState
    HeightRelief relief;
  };

  // Same for the marks of a soft sample.
  struct ShownMarks {
    std::uint64_t marks = 0;  // counter of ParticlesNow at that time
    HeightRelief relief;
  };

  const HeightRelief& sample_in_colours(std::size_t material) const;
  const HeightRelief& marks_of(const ParticlesNow& now) const;
  render::ForcePanel force_panel(const Moment& moment) const;
  render::Banner banner(const Moment& moment) const;

  const WallScene* wall_scene_;
  const Phrases* phrases_;
  const std::vector<curves::SampleModel>* materials_;
  std::array<scene::EyeView, 2> eyes_;
  mutable std::optional<ColouredSample> coloured_;
  mutable std::optional<ShownMarks> marks_;
};

// Colours of the curves, by the material's index in its file; also distinct without red, green or blue vision.
glm::vec3 curve_color(std::size_t material);

}  // namespace afm::exhibit
