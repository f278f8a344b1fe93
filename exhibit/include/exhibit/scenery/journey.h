// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "exhibit/models/model_builder.h"
#include "exhibit/words/phrases.h"
#include "scene/graph/scene.h"

namespace afm::exhibit {

// From the bench to the atoms: one layout unit shows 10^-orders metres.
inline constexpr double kJourneyOrders = 9.0;

// The name of the part that is seen there, such as the cantilever.
Phrase journey_place(double orders);

// The instrument at its true proportions, from the bench to the last atom of its tip, and the samples below it: one
// scale at a time, with the contact point, which stays where it is on the wall, as the origin. Parts are meshes of
// their own size below one frame that scales; transforms are composed in double precision.
class Journey {
 public:
  Journey() = default;
  // Below `layout`, whose units it uses.
  Journey(ModelBuilder& build, scene::Scene& scene, scene::NodeIndex layout);

  // The sample's ground "ground-LOOK.glb", loaded once a look; returns its number.
  std::size_t add_ground(ModelBuilder& build, scene::Scene& scene, const std::string& look);

  // `orders`: 0 to kJourneyOrders, else the nearest of them.
  void place(double orders, std::vector<glm::dmat4>& local) const;

  // True for a node below the journey's frame that is to be drawn: none beyond the fog or smaller than a pixel.
  bool shows(scene::NodeIndex node, double orders, std::size_t ground) const;

  // What stands beside the tip to compare it with at this scale: where its name goes, in the sample's axes about the
  // contact point, layout units.
  struct Companion {
    Phrase name;
    glm::dvec3 place;
  };
  std::optional<Companion> companion(double orders) const;

  scene::NodeIndex frame() const { return frame_; }

 private:
  struct Part {
    scene::NodeIndex node = 0;
    std::optional<std::size_t> ground;     // of which it is a part
    double nearest_m = 0, farthest_m = 0;  // its vertices, from the contact point
  };
  void measure(const scene::Scene& scene, scene::NodeIndex first, std::optional<std::size_t> ground);

  scene::NodeIndex frame_ = 0;
  std::vector<Part> parts_;
  std::vector<std::string> grounds_;
};

// The journey as a person goes on it: the wall dissolves, the instrument appears, the scale goes down to the atoms,
// eased, by equal factors in equal times; and the same way back. It can be turned round at any time.
class JourneyTravel {
 public:
  // Steps: from each power of ten to the next behind a veil, for a headset, in which a scene that moves by itself makes
  // people feel sick.
  enum class Motion { Glide, Steps };
  explicit JourneyTravel(Motion motion = Motion::Glide) : motion_(motion) {}

  void turn_round(std::int64_t now_ns);
  void update(std::int64_t now_ns);

  bool away() const { return progress_s_ > 0.0; }  // from the instrument, or about to leave
  double fade() const;                             // 0..1: how much of what is shown has dissolved
  std::optional<double> orders() const;            // none: the instrument is still, or again, in view

 private:
  Motion motion_;
  double progress_s_ = 0;
  double direction_ = -1;
  std::int64_t updated_ns_ = 0;
};

}  // namespace afm::exhibit
