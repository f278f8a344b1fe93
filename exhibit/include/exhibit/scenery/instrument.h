// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "render/frame.h"
#include "scene/graph/scene.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

class ModelBuilder;
class WallMarks;
struct UserModels;

// The instrument on the wall: probe, stage, and optics. It keeps the indices of its nodes, which are in the wall's
// graph.
class Instrument {
 public:
  Instrument() = default;

  // Appends its nodes: the stage's and the probe's below `sample`, the others below `layout`.
  Instrument(ModelBuilder& build, scene::NodeIndex layout, scene::NodeIndex sample, const UserModels& own);

  // Call once, when the graph has all its models without an error.
  void measure(scene::Scene& scene, ModelBuilder& build);

  // The stage's body ends in the floor at height `y`, and no part of it lies in front of `front_z`. Layout units.
  void set_floor(double y, double front_z) {
    floor_y_ = y;
    body_front_z_ = front_z;
  }

  // State of the tip, and the scale of its picture.
  struct Setting {
    scene::Tip tip;
    double layout_per_m = 0;       // layout units per metre of the nanoworld
    glm::dvec3 below_tip{0.0};     // point of the surface, sample's frame, layout units
    double full_deflection_m = 1;  // deflection at which the spot reaches the edge of the diode
    double strobe_m = 0;           // deflection of the slow-motion swing, shown by lever and light but not by the arrow
  };

  // Each function sets the transforms of its nodes from their parents.
  void place_probe(const scene::Scene& scene, const Setting& setting, const WallMarks& marks,
                   std::vector<glm::dmat4>& local, render::BeamBend& bend) const;
  // A pale copy of the lever.
  void place_ghost(const Setting& setting, std::vector<glm::dmat4>& local, render::BeamBend& bend) const;
  // The space swept by the lever as it swings about that pose, and the tip at both turning points.
  void place_swing(const Setting& setting, double amplitude_m, std::vector<glm::dmat4>& local,
                   render::BeamBend& bend) const;
  void place_optics(const scene::Scene& scene, const Setting& setting, std::vector<glm::dmat4>& local) const;
  void place_stage(const scene::Scene& scene, double thickness, std::vector<glm::dmat4>& local) const;

  double lever_length() const { return lever_length_; }
  double tip_length() const { return tip_length_; }
  double stage_height() const { return stage_height_; }

  scene::NodeIndex lever() const { return lever_; }
  scene::NodeIndex apex() const { return apex_; }
  scene::NodeIndex ghost() const { return ghost_; }
  std::array<scene::NodeIndex, 3> swing() const { return {band_, turns_[0], turns_[1]}; }
  scene::NodeIndex optics() const { return optics_; }
  scene::NodeIndex stage() const { return stage_; }
  scene::NodeIndex floor() const { return floor_; }
  scene::NodeIndex floor_surface() const { return floor_surface_; }

 private:
  // Pose of the lever in the sample's frame, layout units.
  struct LeverPose {
    glm::dmat4 frame_from_lever{1.0};  // origin at the clamp, x along the unbent lever, z away from the sample
    double end = 0;                    // height of the bent lever's end, along z
    double angle = 0;                  // slope of the lever at that end, rad
  };

  LeverPose lever_pose(const Setting& setting) const;

  scene::NodeIndex layout_{}, sample_frame_{}, probe_frame_{}, lever_{}, cantilever_{}, tip_{}, apex_{}, ghost_{},
      band_{}, stage_{}, body_{}, floor_{}, floor_surface_{};
  std::array<scene::NodeIndex, 2> turns_{};  // tip at the highest and the lowest point of the swing
  scene::NodeIndex optics_{}, laser_{}, photodiode_{}, beam_in_{}, beam_out_{}, spot_{};
  double lever_length_ = 0;  // distance from clamp to tip axis in glTF metres
  double tip_length_ = 0;    // length from base to apex in glTF metres
  double stage_scale_ = 0, stage_height_ = 0, stage_depth_ = 0, body_depth_ = 0;
  double floor_y_ = 0, body_front_z_ = 0;
};

}  // namespace afm::exhibit
