// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "exhibit/scenery/analogy.h"
#include "exhibit/scenery/instrument.h"
#include "exhibit/scenery/journey.h"
#include "exhibit/scenery/stage_particles.h"
#include "exhibit/scenery/wall_marks.h"
#include "exhibit/scenery/wall_places.h"
#include "exhibit/state/wall_state.h"
#include "exhibit/words/phrases.h"
#include "input/selection.h"
#include "render/frame.h"
#include "scene/display/wall.h"
#include "scene/graph/scene.h"
#include "scene/samples/material_library.h"
#include "scene/shared/felt_heights.h"
#include "scene/shared/shared_blocks.h"

namespace afm::exhibit {

struct HeightRelief;
class ModelBuilder;
struct UserModels;

// Drawing scales: metres of the nanoworld (or of the instrument) per metre of the wall.
struct DrawnScale {
  double sample_m_per_m = 0;  // scale of sample, displacement and deflection
  double lever_m_per_m = 0;   // scale of chip and cantilever
  double tip_m_per_m = 0;     // scale of the tip
};

// The scene on the wall: its models, their places, and their motion with the tip. Built once, const afterwards. Shows
// the same picture on a wall of any size.
class WallScene {
 public:
  static core::Result<WallScene> load(const std::string& assets_dir, const scene::MaterialLibrary& materials,
                                      const StagePlace& place, const Phrases& phrases, const UserModels& own);
  static core::Result<WallScene> load(const std::string& assets_dir, const scene::MaterialLibrary& materials,
                                      const StagePlace& place, const Phrases& phrases);

  // Language of all texts on this wall.
  const Phrases& phrases() const { return phrases_; }

  const scene::Scene& scene() const { return scene_; }
  scene::NodeIndex sample_node() const { return sample_frame_; }

  // Swatches as targets of the wand, in the order of the materials.
  std::vector<input::Target> swatch_targets() const;

  // Felt surfaces, as drawn.
  std::span<const scene::SharedHeightField> height_fields() const { return height_fields_; }

  // Measured topography that replaces them, without columns if there is none; and its scale on a material.
  const scene::Topography& topography() const { return topography_; }
  scene::TopographyScale topography_scale(std::size_t material) const { return looks_[material].topography; }

  // Stores in a material's parameters its felt surface, and the size of that surface: whatever the
  // stroke, the sample is drawn at the same size, and the hand feels it there.
  void lay_surface_on(scene::SharedContact& parameters, std::size_t material) const {
    parameters.height_field = looks_[material].height_field;
    parameters.topography = looks_[material].topography;
    parameters.surface_release_m = looks_[material].surface_stroke_m / kStrokeOfZjoc;
  }

  // Contact point; in the wall's plane until something has been moved.
  glm::dvec3 contact_m() const { return glm::dvec3(places_.room_from_layout()[3]); }

  // Places of its panels, and of the wand in a simulated person's hand.
  const WallPlaces& places() const { return places_; }

  // Size of one layout unit in metres, chosen so that every wall looks the same.
  double unit_m() const { return places_.unit_m(); }

  // Size of a panel's millimetre in metres; larger than the layout's if the text is enlarged.
  double panel_millimetre_m() const { return 1e-3 * text_size_ * unit_m(); }
  void set_text_size(double times) { text_size_ = times; }  // only before the first frame

  // Outward normal of the sample and its x axis, to the right; unit vectors in the room frame.
  glm::dvec3 sample_normal() const;
  glm::dvec3 sample_right() const;

  // Metres of the nanoworld per metre of the wall, at a point of the journey.
  double journey_m_per_m(double orders) const;

  // `release_z_m` as in WallState.
  DrawnScale drawn_scale(std::size_t material, double release_z_m = 0) const;

  // Transforms of all nodes, room from node.
  std::vector<glm::dmat4> node_transforms(const WallState& state) const;

  // Lays an image on the sample in front, with its colour scale beside it. Call after update(), with the same state.
  void lay_on_sample(const HeightRelief& relief, const WallState& state, render::FrameState& frame) const;

  // Same for marks; draws the level sample below the deepest of them.
  void lay_marks(const HeightRelief& relief, const WallState& state, render::FrameState& frame) const;

  // Moves the ruler's number to the left of the ruler, to make room on its right. Call like lay_on_sample().
  void clear_right_of_ruler(const WallState& state, render::FrameState& frame) const;

  // Fills the frame's transforms, visibility, highlights, bend, light, labels and panel placements.
  void update(const WallState& state, render::FrameState& frame) const;

 private:
  struct MaterialLook {
    std::size_t ground;       // index of the ground in the journey
    scene::NodeIndex sample;  // frame with the sample's scale
    scene::NodeIndex swatch;
    scene::NodeIndex label;    // node at the place of the name on the swatch
    double stroke_m;           // height from the deepest push to the highest lift
    double surface_stroke_m;   // stroke at which the surface has its original size
    double full_deflection_m;  // deflection at pull-off
    double thickness_m;        // thickness of the slab at the surface's original size
    std::uint32_t height_field;
    scene::TopographyScale topography;
  };

  void add_frames(ModelBuilder& build, const UserModels& own);
  void add_material(ModelBuilder& build, const std::string& assets_dir, const scene::MaterialEntry& material,
                    const UserModels& own);
  void add_topography(ModelBuilder& build, const std::string& sample, const UserModels& own, MaterialLook& look);
  std::uint32_t height_field_of(const std::string& model, scene::NodeIndex surface);
  void place_sample(const WallState& state, std::vector<glm::dmat4>& local) const;
  void place_wand(const WallState& state, std::vector<glm::dmat4>& local) const;
  double parameter_factor(std::size_t material, double release_z_m) const;  // ratio of Z_joc to the material's own
  double layout_per_m(const WallState& state) const;                        // layout units per metre of the nanoworld
  glm::dvec3 below_tip(const WallState& state) const;     // surface point below the tip, sample's frame, layout units
  double ruler_m_per_unit(const WallState& state) const;  // metres per layout unit at the ruler; 0: no ruler
  Analogy::Heights analogy_heights(const WallState& state) const;
  std::vector<scene::NodeIndex> hidden_roots(const WallState& state) const;
  void place_swatch_labels(const WallState& state, render::FrameState& frame) const;
  void place_analogy_labels(const WallState& state, render::FrameState& frame) const;
  void place_marks(const WallState& state, render::FrameState& frame) const;
  std::vector<glm::dmat4> local_transforms(const WallState& state, std::vector<render::BeamBend>& bends) const;

  scene::Scene scene_;
  Phrases phrases_;
  std::vector<std::string> titles_;  // titles of the swatches, in the language of the wall
  std::vector<MaterialLook> looks_;
  std::vector<scene::SharedHeightField> height_fields_;
  scene::Topography topography_;
  std::optional<std::uint32_t> topography_mesh_;
  double topography_relief_m_ = 0;  // range of the colour scale
  double topography_exaggeration_ = 1;
  scene::NodeIndex height_bar_{}, relief_{};
  std::vector<std::string> surface_models_;  // model files of the surfaces, in the order of height_fields_
  WallPlaces places_;
  double text_size_ = 1.0;

  scene::NodeIndex layout_{}, sample_frame_{}, wand_{}, ray_{};
  Instrument instrument_;
  WallMarks marks_;
  Journey journey_;
  Analogy analogy_;
  std::optional<StageParticles> particles_;
};

}  // namespace afm::exhibit
