// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string_view>

#include "fits/layer.h"

// Elastic contacts (docs/fits.md; equation numbers (F...)). Any thread.
namespace afm::fits {

enum class Shape {
  Paraboloid,
  Sphere,
  Cone,
  Pyramid3,
  Pyramid4Bilodeau,
  Pyramid4Rico,
  LayerSphere,
  LayerCone,
  LayerExactSphere,
  LayerExactCone,
  LayerDimitriadis,
  Dmt,
  Jkr,
  Maugis,
  Auto  // Dmt, Jkr or Maugis, selected by the fit
};

// Description of a shape for options, reports and checks.
struct ShapeRow {
  Shape shape;
  std::string_view name;     // name on the command line and in reports
  bool has_radius;           // true: needs a radius; false: needs a half angle
  bool has_layer;            // true: needs the thickness of a layer
  bool is_exact;             // true: a layer of any Poisson ratio, on any base; the others need 0.5, bonded
  bool is_adhesive;          // true: a law of adhesion, fitted to both branches
  std::string_view meaning;  // description with its source, in one line
  // True: without adhesion the force is one power of the depth, d^1.5 of a tip with a radius, d^2 of one with an angle.
  bool is_power;
  double sharp = 0;                              // c in the force c tan(a) E* d^2; 0 for a tip with a radius
  const std::array<double, 4>* layer = nullptr;  // terms by which a layer stiffens; null for no layer or a table
};

// Rows in the order of Shape.
extern const std::array<ShapeRow, 15> kShapes;

const ShapeRow& row_of(Shape shape);

struct Indenter {
  Shape shape = Shape::Sphere;
  double radius_m = 0;        // tip radius; positive if the shape needs one
  double half_angle_rad = 0;  // angle between axis and edge of a cone, axis and face of a pyramid; in (0, pi/2)
  double layer_m = 0;         // thickness on a rigid base; positive if the shape needs one
  std::shared_ptr<const LayerTable> table{};  // exact_table() of the shape; not null if it is exact
  Base base = Base::Bonded;                   // base of the table
  double atomic_distance_m = 0.3e-9;          // z0 of the attraction, for Maugis and Tabor's parameter
};

// Table of an exact layer.
std::shared_ptr<const LayerTable> exact_table(Shape shape, Base base, double poisson);

// Force at a depth per pascal of the reduced modulus E* = E/(1 - nu^2).
struct Push {
  double force = 0;  // force per modulus, N/Pa
  double slope = 0;  // derivative by the depth, N/(m Pa)
};

// Push at a depth in metres; zero above the sample. A law of adhesion counts as its paraboloid, without adhesion.
Push push_of(const Indenter& indenter, double depth_m) noexcept;

// Force of a tip of one power: coefficient E* d^1.5 of a blunt one, coefficient E* d^2 of a sharp one.
struct PowerLaw {
  bool is_sharp = false;
  double coefficient = 0;
};

// Power law of an indenter; empty for a sphere and for layers; a law of adhesion counts as its paraboloid.
std::optional<PowerLaw> power_law_of(const Indenter& indenter) noexcept;

// Strain of the layer over the largest at which the shape's formula is within 1 % of the exact layer (lab cases P09 to
// P20): sqrt(R d)/h over 0.5, or d tan(alpha)/h over 0.9; for an exact layer, over the largest strain in its table. 0
// for a thick sample.
double layer_strain(const Indenter& indenter, double depth_m) noexcept;

}  // namespace afm::fits
