// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/graph/scene.h"

namespace afm::exhibit {

// Smooth, level sample that particles rest on: node "surface" with a mesh in metres, a square with this side around the
// origin and its upper face at z = 0.
scene::Scene particle_ground(double side_m);

// Particle of radius 1 around the origin, with bands that show how it lies: node "sphere".
scene::Scene particle_sphere();

// Rod of radius 1 along x around the origin, with round ends beyond its length and the front one coloured: node "rod".
scene::Scene particle_rod(double length);

// Flat island around the origin, 2 high, its rim a half circle of radius 1 beyond the radius `core`, with a dark sector
// from its middle towards +x that shows how it is turned: node "island".
scene::Scene particle_island(double core);

// Flat pad of that size around the origin, on the sample: node "pad".
scene::Scene particle_pad(double width, double height);

// Same for a pad to which spheres stick.
scene::Scene particle_sticky_pad(double width, double height);

// Ring around a particle of radius 1 that rests on z = 0: node "ring".
scene::Scene particle_ring();

// Ring on the sample at the original place of a particle of radius 1: node "footprint".
scene::Scene particle_footprint();

// Dot on the sample, one of a line between the footprint and a particle of radius 1: node "dot".
scene::Scene particle_dot();

// Cross on the sample at the target of a particle of radius 1: node "target".
scene::Scene particle_target();

// Tip of true shape: a cone that ends in a ball of radius 1, with its apex at the origin, z up to `height`: node "tip".
scene::Scene particle_tip(double half_angle_rad, double height);

}  // namespace afm::exhibit
