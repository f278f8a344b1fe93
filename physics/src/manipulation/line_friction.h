// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

// Friction that is uniform along the line on which a rod rests (docs/manipulation.md, "Rods").
namespace afm::physics {

// Motion of a rod, or the forces that do work on it, in its frame: along its axis, across it, and the motion of its
// front end across less that of its middle. For small motions the turn is this over half the length.
using RodVector = std::array<double, 3>;
using RodMatrix = std::array<RodVector, 3>;

// Mean way of the points of a rod, and its derivatives. The friction of the motion is the force that moves the rod
// sideways times this; its gradient is the friction force and moment (M18).
//
//   mean = 1/2 integral over w from -1 to 1 of sqrt(along^2 + (across + end w)^2)
struct MeanWay {
  double way = 0.0;
  RodVector slope{};
};
MeanWay mean_way(const RodVector& motion) noexcept;

// Second derivatives of the mean way, for a motion that is not zero. Those along the axis have a singularity where a
// point of the rod does not move; they are finite here.
RodMatrix mean_way_curvature(const RodVector& motion) noexcept;

// The motion that a load drives with the most work per mean way.
struct DrivenMotion {
  double force = 0.0;  // work over way: the rod moves if this exceeds the force needed to move it sideways
  RodVector motion{};
};
DrivenMotion driven_motion(const RodVector& load) noexcept;

}  // namespace afm::physics
