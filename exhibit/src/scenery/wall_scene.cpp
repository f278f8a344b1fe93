// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scenery/wall_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "core/check.h"
#include "core/log.h"
#include "exhibit/models/model_builder.h"
#include "exhibit/models/particle_models.h"
#include "exhibit/models/relief.h"
#include "exhibit/models/user_models.h"
#include "exhibit/models/volume_shapes.h"
#include "imaging/drawn_surface.h"
#include "models/height_bar.h"
#include "physics/contact.h"
#include "scene/graph/height_field.h"
#include "scene/samples/particle_set.h"

namespace afm::exhibit {

namespace {

using glm::dmat4;
using glm::dvec3;

// Stroke that suits a sample of this width: the material's own, unless the sample would then cover the wall or be
// a stamp on it.
double stroke_of_sample(double width_m, double stroke_m) {
  return std::clamp(stroke_m, width_m / kWidestSample, width_m / kNarrowestSample);
}

// Names the scale of an own sample that is too wide for the stroke, and would hide panels and swatches.
void note_smaller_sample(const std::string& title, double scale) {
  if (scale >= 1.0) return;
  core::log_line(
      fmt::format("{}: your sample is wider than {} strokes of the tip, so it is drawn and felt at {:.2g} of its size",
                  title, kWidestSample, scale));
}

// Place of the colour scale of heights: seen beside its numbers, which are in the wall's plane, but so near to the eye
// that the floor does not hide its lower part.
dmat4 height_bar_place(double left, double floor_y, const dvec3& eye) {
  constexpr double kAboveFloor = 0.01, kNearest = 0.25;  // fraction of the way to the eye
  const dvec3 foot(left, kHeightBarBottom, 0.0);
  const double nearer = std::clamp((floor_y + kAboveFloor - foot.y) / std::max(eye.y - foot.y, 0.1), 0.0, kNearest);
  return glm::scale(glm::translate(dmat4(1.0), glm::mix(foot, eye, nearer)), dvec3(kHeightBarHeight * (1.0 - nearer)));
}

}  // namespace

void WallScene::add_frames(ModelBuilder& build, const UserModels& own) {
  layout_ = build.frame("layout", std::nullopt, places_.room_from_layout());
  const double c = std::cos(kSampleTiltRad), s = std::sin(kSampleTiltRad);
  sample_frame_ = build.frame("sample", layout_, frame_matrix({1, 0, 0}, {0, s, -c}, {0, c, s}, dvec3(0.0)));
  instrument_ = Instrument(build, layout_, sample_frame_, own);
  build.model("wand.glb", "wand", layout_);
  wand_ = build.node("wand/wand");
  ray_ = build.node("wand/ray");
  marks_ = WallMarks(build, scene_, layout_, sample_frame_);
  analogy_ = Analogy(build, scene_, sample_frame_);
  journey_ = Journey(build, scene_, layout_, places_.journey_view());
  if (own.particles) particles_.emplace(*own.particles, build, scene_, sample_frame_);
  height_bar_ = build.part(height_bar(kHeightBarWidth / kHeightBarHeight), "height-bar", layout_);
  build.part(relief_mesh(), "image", sample_frame_);
  relief_ = build.node("image/relief");
  if (own.force_volume) {
    build.part(slice_mesh(), "slice", sample_frame_);
    build.part(force_bar(kForceBarWidth), "force-bar", sample_frame_);
    build.part(equal_force_mesh(), "equal-force", sample_frame_);
  }
}

void WallScene::add_material(ModelBuilder& build, const std::string& assets_dir, const scene::MaterialEntry& material,
                             const UserModels& own) {
  const physics::ApproachRetractEvents events = physics::approach_retract_events(material.contact);
  MaterialLook look{};
  const std::string model = imaging::model_of(assets_dir, material);
  const std::string sample = "sample-" + material.name;
  look.stroke_m = own.particles ? StageParticles::stroke_m(*own.particles) : events.z_joc.si * kStrokeOfZjoc;
  look.surface_stroke_m = look.stroke_m;
  if (own.topography) {
    add_topography(build, sample, own, look);
  } else if (own.particles) {
    // the plane on which the servo pushes them
    look.sample = build.part(with_outline(particle_ground(kNarrowestSample * look.stroke_m)), sample, sample_frame_);
    look.height_field = scene::kNoHeightField;
    look.thickness_m = build.error() ? 0.0 : -bounds_below(scene_, look.sample).low.z;
  } else {
    look.sample = own.sample ? build.part(sample_as(*own.sample, material), sample, sample_frame_)
                             : build.model_in_frame_of("surface", "sample-" + model + ".glb", sample, sample_frame_);
    const scene::NodeIndex surface = build.node(sample + "/surface");
    look.height_field = build.error() ? scene::kNoHeightField : height_field_of(own.sample ? "own" : model, surface);
    const scene::Bounds slab = build.error() ? scene::Bounds{dvec3(0.0), dvec3(0.0)} : bounds_below(scene_, surface);
    look.thickness_m = -slab.low.z;
    const dvec3 side = slab.high - slab.low;
    look.surface_stroke_m = own.sample ? std::max(look.stroke_m, std::max(side.x, side.y) / kWidestSample)
                                       : stroke_of_sample(side.x, look.stroke_m);
    if (own.sample) note_smaller_sample(material.title, look.stroke_m / look.surface_stroke_m);
  }
  look.ground = journey_.add_ground(build, scene_, model);
  const std::string swatch = "swatch-" + material.name;
  look.swatch = build.model("swatch-" + model + ".glb", swatch, layout_);
  look.label = build.node(swatch + "/label");
  look.full_deflection_m = events.f_ad.si / material.contact.spring_constant.si;
  looks_.push_back(look);
}

core::Result<WallScene> WallScene::load(const std::string& assets_dir, const scene::MaterialLibrary& materials,
                                        const StagePlace& place, const Phrases& phrases) {
  return load(assets_dir, materials, place, phrases, UserModels{});
}

core::Result<WallScene> WallScene::load(const std::string& assets_dir, const scene::MaterialLibrary& materials,
                                        const StagePlace& place, const Phrases& phrases, const UserModels& own) {
  WallScene w;
  w.phrases_ = phrases;
  w.places_ = WallPlaces(place, materials.materials.size());
  ModelBuilder build(assets_dir + "/models", w.scene_);
  w.add_frames(build, own);
  for (const scene::MaterialEntry& material : materials.materials) {
    w.add_material(build, assets_dir, material, own);
    const auto of_this_title = [&](const scene::MaterialEntry& other) { return other.title == material.title; };
    const bool alone = std::count_if(materials.materials.begin(), materials.materials.end(), of_this_title) == 1;
    const std::string title = phrases.word(material.title);
    w.titles_.push_back(alone ? title : phrases.text<Phrase::TitleAndMedium>(title, phrases.word(material.medium)));
  }
  if (build.error()) return tl::unexpected(*build.error());

  w.instrument_.measure(w.scene_, build);
  double floor_y = w.places_.shelf_y();
  for (const MaterialLook& look : w.looks_) {
    const double thickness = look.thickness_m * kStrokeHeight / look.surface_stroke_m + w.instrument_.stage_height();
    floor_y = std::min(floor_y, -std::cos(kSampleTiltRad) * thickness - kLeastBody);
  }
  // the body would hide swatches inside it
  const double last_swatch_z = w.places_.swatch(w.looks_.size() - 1, w.looks_.size()).z;
  w.instrument_.set_floor(floor_y, last_swatch_z - kSwatchBehind);
  const dvec3 eye(glm::inverse(w.places_.room_from_layout()) * glm::dvec4(place.viewer_m, 1.0));
  w.scene_.nodes[w.height_bar_].parent_from_node = height_bar_place(w.places_.height_bar_x(), floor_y, eye);
  return w;
}

// Adds one mesh for all materials, in metres as measured. Each material's node contains its scale.
void WallScene::add_topography(ModelBuilder& build, const std::string& sample, const UserModels& own,
                               MaterialLook& look) {
  const TopographyModel& model = *own.topography;
  look.height_field = scene::kTopography;
  look.topography = exhibit::topography_scale(model, look.stroke_m);
  const dmat4 shown =
      glm::scale(dmat4(1.0), dvec3(look.topography.lateral, look.topography.lateral, look.topography.vertical));
  if (!topography_mesh_) {
    topography_ = model.topography;
    topography_relief_m_ = model.highest_m - model.lowest_m;
    topography_exaggeration_ = model.exaggeration;
    look.sample = build.part(model.sample, sample, sample_frame_);
    topography_mesh_ = scene_.nodes[build.node(sample + "/surface")].mesh;
  } else {
    look.sample = build.frame(sample, sample_frame_, dmat4(1.0));
    build.frame(sample + "/surface", look.sample, dmat4(1.0));
  }
  scene::Node& surface = scene_.nodes[build.node(sample + "/surface")];
  surface.mesh = topography_mesh_;
  surface.parent_from_node = shown;
  look.thickness_m = -bounds_below(scene_, look.sample).low.z;
}

// Index of a model's surface, shared by its materials. Surfaces beyond the servo's capacity are felt as planes.
std::uint32_t WallScene::height_field_of(const std::string& model, scene::NodeIndex surface) {
  const auto known = std::find(surface_models_.begin(), surface_models_.end(), model);
  if (known != surface_models_.end()) return static_cast<std::uint32_t>(known - surface_models_.begin());
  const auto field = scene::height_field_below(scene_, surface);
  if (!field || height_fields_.size() == scene::kMaxHeightFields) return scene::kNoHeightField;
  surface_models_.push_back(model);
  height_fields_.push_back(*field);
  return static_cast<std::uint32_t>(height_fields_.size() - 1);
}

double WallScene::parameter_factor(std::size_t material, double release_z_m) const {
  if (particles_) return 1.0;  // scale set by the particles' size, whatever the tip's parameters
  return release_z_m > 0.0 ? release_z_m * kStrokeOfZjoc / looks_[material].stroke_m : 1.0;
}

DrawnScale WallScene::drawn_scale(std::size_t material, double release_z_m) const {
  const double unit_m = places_.unit_m();
  const double stroke_m = looks_[material].stroke_m * parameter_factor(material, release_z_m);
  return {.sample_m_per_m = stroke_m / (kStrokeHeight * unit_m),
          .lever_m_per_m = instrument_.lever_length() / (kLeverDrawnLength * unit_m),
          .tip_m_per_m = instrument_.tip_length() / (kTipDrawnLength * unit_m)};
}

double WallScene::journey_m_per_m(double orders) const { return std::pow(10.0, -orders) / places_.unit_m(); }

double WallScene::layout_per_m(const WallState& state) const {
  // before a choice the stage is empty, and the tip is at zero height
  if (!state.material) return 0.0;
  return kStrokeHeight / (looks_[*state.material].stroke_m * parameter_factor(*state.material, state.release_z_m));
}

std::vector<input::Target> WallScene::swatch_targets() const {
  std::vector<input::Target> targets;
  targets.reserve(looks_.size());
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    targets.push_back(
        {dvec3(places_.room_from_layout() * glm::dvec4(places_.swatch(i, looks_.size()) + kSwatchCenter, 1.0)),
         kSwatchRadius * places_.unit_m()});
  }
  return targets;
}

glm::dvec3 WallScene::sample_normal() const {
  return glm::normalize(
      dvec3(places_.room_from_layout() * scene_.nodes[sample_frame_].parent_from_node * glm::dvec4(0, 0, 1, 0)));
}

glm::dvec3 WallScene::sample_right() const {
  return glm::normalize(
      dvec3(places_.room_from_layout() * scene_.nodes[sample_frame_].parent_from_node * glm::dvec4(1, 0, 0, 0)));
}

glm::dvec3 WallScene::below_tip(const WallState& state) const {
  if (const auto apex_m = StageParticles::apex_m(state.particles); particles_ && apex_m) {
    return layout_per_m(state) * dvec3(apex_m->x, apex_m->y, 0.0);
  }
  const auto& [x, y] = state.surface.xy_m;
  return layout_per_m(state) * dvec3(x, y, state.surface.height_m);
}

}  // namespace afm::exhibit
