// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "exhibit/models/model_builder.h"
#include "exhibit/words/phrases.h"
#include "render/frame.h"
#include "scene/graph/scene.h"

namespace afm::exhibit {

// Length of the journey from the bench to the atoms. At `orders` of it, one layout unit shows 10^-orders metres.
inline constexpr double kJourneyOrders = 9.0;

// Name of the visible part at this point, such as the cantilever.
Phrase journey_place(double orders);

// The instrument at its true proportions, from the bench to the last atom of its tip, and the samples below it, at one
// scale at a time. The origin is the contact point, which keeps its place on the wall. Each part is a mesh of its real
// size below one common frame that scales; transforms are composed in double precision.
class Journey {
 public:
  // Places in layout units from the contact point: the viewer's eyes, and the lower corners of the screen.
  struct View {
    glm::dvec3 eye{0.0, 0.0, 1.0};
    std::array<glm::dvec3, 2> lower_corners{};
  };

  Journey() = default;
  // Adds its nodes below `layout`, whose units it uses. Under the tip, the ground is turned so that the eyes are below
  // the ball of the tip.
  Journey(ModelBuilder& build, scene::Scene& scene, scene::NodeIndex layout, const View& view);

  // Loads the sample's ground "ground-LOOK.glb", once per look, and returns its number.
  std::size_t add_ground(ModelBuilder& build, scene::Scene& scene, const std::string& look);

  // Places all parts, the samples' atoms below their ground until they fill the view down to its lower border. Clamps
  // `orders` to 0 to kJourneyOrders.
  void place(double orders, std::vector<glm::dmat4>& local) const;

  // Returns whether a node below the journey's frame needs drawing: not in the fog, not below the ground, and at least
  // a pixel large.
  bool shows(scene::NodeIndex node, double orders, std::size_t ground) const;

  // Sets the shadows: the triangles' shadows down to the lever, then the tip's soft one on the ground, whose
  // length no shadow map covers. `unit_m` is a layout unit in the room.
  void shade(double orders, const glm::dmat4& room_from_frame, double unit_m, render::FrameState& frame) const;

  // A familiar object next to the tip for comparison at this scale, with the place of its label, in the sample's axes
  // relative to the contact point, layout units.
  struct Companion {
    Phrase name;
    glm::dvec3 place;
  };
  std::optional<Companion> companion(double orders) const;

  // Distance of the last atom of the tip from the sample.
  double gap_m() const { return tip_.gap_m; }

  scene::NodeIndex frame() const { return frame_; }

 private:
  // End of the tip in its model: a ball on a cone between the pyramid's faces and its edges.
  struct Tip {
    double gap_m = 0;     // distance from the sample to the last atom
    double lowest_m = 0;  // distance from the sample to the ball
    double radius_m = 0;  // radius of the ball
    double height_m = 0;  // height from the ball's lowest point to the tip's base
    double slope = 0;
  };
  void measure_tip(const scene::Scene& scene, ModelBuilder& build);

  struct Part {
    scene::NodeIndex node = 0;
    std::optional<std::size_t> ground;     // ground that contains the part
    double nearest_m = 0, farthest_m = 0;  // distances of its vertices from the contact point
  };
  void measure(const scene::Scene& scene, scene::NodeIndex first, std::optional<std::size_t> ground);

  scene::NodeIndex frame_ = 0;
  double low_tilt_rad_ = 0;     // tilt of the ground under the tip
  double atoms_at_orders_ = 0;  // orders from which the samples' atoms are out of the ground
  Tip tip_;
  std::vector<Part> parts_;
  std::vector<scene::NodeIndex> atoms_, ground_atoms_;  // atoms with an outline, and atoms of the samples
  scene::NodeIndex tip_atoms_ = 0;
  std::vector<std::string> grounds_;
};

// The animation of the journey: the wall dissolves, the instrument appears, and the scale decreases to the atoms,
// eased, by equal factors in equal times; then the same way back. Can be reversed at any time.
class JourneyTravel {
 public:
  // Steps: jumps from each power of ten to the next while the picture is blank, for a headset, in which a moving scene
  // causes motion sickness.
  enum class Motion { Glide, Steps };
  explicit JourneyTravel(Motion motion = Motion::Glide) : motion_(motion) {}

  void turn_round(std::int64_t now_ns);
  void update(std::int64_t now_ns);

  bool away() const { return progress_s_ > 0.0; }  // true: view away from the instrument, or about to leave it
  double fade() const;                             // dissolved fraction of the picture, 0 to 1
  std::optional<double> orders() const;            // position on the journey; empty while the instrument is in view

 private:
  Motion motion_;
  double progress_s_ = 0;
  double direction_ = -1;
  std::int64_t updated_ns_ = 0;
};

}  // namespace afm::exhibit
