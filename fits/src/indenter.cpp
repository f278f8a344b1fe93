// SPDX-License-Identifier: Apache-2.0
#include "fits/indenter.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace afm::fits {

namespace {

constexpr double kPi = std::numbers::pi;

// (F1): F = 4/3 E* sqrt(R) d^(3/2)
Push paraboloid(double radius_m, double depth_m) {
  const double slope = 2.0 * std::sqrt(radius_m * depth_m);
  return {2.0 / 3.0 * slope * depth_m, slope};
}

// (F2): with x = a/R, d/R = x artanh(x), F = E* R^2 [(1 + x^2) artanh(x) - x], dF/dd = 2 E* a
Push sphere(double radius_m, double depth_m) {
  constexpr double kShallow = 0.01;  // below, the series is exact to 1e-12 and the difference above is not
  const double t = depth_m / radius_m;
  if (t < kShallow) {
    const Push flat = paraboloid(radius_m, depth_m);
    const double factor = 1.0 + t * (-0.1 + t * (-1.0 / 840.0 + t * (11.0 / 15120.0)));
    const double growth = t * (-0.1 + t * (-2.0 / 840.0 + t * (33.0 / 15120.0)));
    return {flat.force * factor, flat.slope * (factor + 2.0 / 3.0 * growth)};
  }
  double y = std::sqrt(t * (1.0 + t / 3.0));  // artanh(x); Newton from above
  double x = 0.0;
  for (int i = 0; i < 12; ++i) {
    x = std::tanh(y);
    const double step = (y * x - t) / (x + y * (1.0 - x) * (1.0 + x));
    y -= step;
    if (std::abs(step) < 1e-14 * y) break;
  }
  x = std::tanh(y);
  return {radius_m * radius_m * ((1.0 + x * x) * y - x), 2.0 * radius_m * x};
}

// (F3): F = c tan(alpha) E* d^2
Push sharp(double coefficient, double half_angle_rad, double depth_m) {
  const double slope = 2.0 * coefficient * std::tan(half_angle_rad) * depth_m;
  return {0.5 * slope * depth_m, slope};
}

// The force of a thick sample times 1 + c1 s + c2 s^2 + c3 s^3 + c4 s^4, where s grows like d^power.
Push in_layer(const Push& thick, double s, double power, double depth_m, const std::array<double, 4>& c) {
  const double factor = 1.0 + s * (c[0] + s * (c[1] + s * (c[2] + s * c[3])));
  const double growth = s * (c[0] + s * (2.0 * c[1] + s * (3.0 * c[2] + s * 4.0 * c[3])));
  return {thick.force * factor, thick.slope * factor + thick.force * growth * power / depth_m};
}

constexpr std::array kGarciaSphere{1.133, 1.497, 1.469, 0.755};  // (F4)
constexpr std::array kGarciaCone{0.721, 0.650, 0.491, 0.225};    // (F5)

// (F6): the rounded coefficients of the paper, for a bonded layer of nu = 0.5
constexpr std::array kDimitriadis{1.133, 1.283, 0.769, 0.0975};

double contact_over_layer(const Indenter& indenter, double depth_m) {
  return std::sqrt(indenter.radius_m * depth_m) / indenter.layer_m;
}

}  // namespace

const std::array<ShapeRow, 9> kShapes{{
    {Shape::Paraboloid, "paraboloid", true, false, "Hertz 1881, (4/3) E* sqrt(R) d^1.5; nanite's hertz_para"},
    {Shape::Sphere, "sphere", true, false, "Sneddon 1965, exact"},
    {Shape::Cone, "cone", false, false, "Sneddon 1965, (2/pi) tan(a) E* d^2"},
    {Shape::Pyramid3, "pyramid3", false, false, "three faces, 0.8887 tan(a) E* d^2, as in nanite 4.2"},
    {Shape::Pyramid4Bilodeau, "pyramid4-bilodeau", false, false, "four faces, 0.7453 tan(a) E* d^2, Bilodeau 1992"},
    {Shape::Pyramid4Rico, "pyramid4-rico", false, false, "four faces, 0.7071 tan(a) E* d^2, Rico 2005, as in JPK's"},
    {Shape::LayerSphere, "layer-sphere", true, true, "bonded layer, nu 0.5, Garcia & Garcia 2018"},
    {Shape::LayerCone, "layer-cone", false, true, "bonded layer, nu 0.5, Garcia & Garcia 2018"},
    {Shape::LayerDimitriadis, "layer-dimitriadis", true, true,
     "bonded layer, nu 0.5, Dimitriadis 2002: biased, 5 % low at sqrt(R d)/h = 0.42"},
}};

const ShapeRow& row_of(Shape shape) { return kShapes.at(static_cast<std::size_t>(shape)); }

Push push_of(const Indenter& indenter, double depth_m) noexcept {
  if (!(depth_m > 0.0)) return {};
  const double angle_rad = indenter.half_angle_rad;
  switch (indenter.shape) {
    case Shape::Paraboloid:
      return paraboloid(indenter.radius_m, depth_m);
    case Shape::Sphere:
      return sphere(indenter.radius_m, depth_m);
    case Shape::Cone:
      return sharp(2.0 / kPi, angle_rad, depth_m);
    case Shape::Pyramid3:
      return sharp(0.8887, angle_rad, depth_m);
    case Shape::Pyramid4Bilodeau:
      return sharp(0.7453, angle_rad, depth_m);
    case Shape::Pyramid4Rico:
      return sharp(1.0 / std::numbers::sqrt2, angle_rad, depth_m);
    case Shape::LayerSphere:
      return in_layer(paraboloid(indenter.radius_m, depth_m), contact_over_layer(indenter, depth_m), 0.5, depth_m,
                      kGarciaSphere);
    case Shape::LayerCone:
      return in_layer(sharp(2.0 / kPi, angle_rad, depth_m), depth_m * std::tan(angle_rad) / indenter.layer_m, 1.0,
                      depth_m, kGarciaCone);
    case Shape::LayerDimitriadis:
      return in_layer(paraboloid(indenter.radius_m, depth_m), contact_over_layer(indenter, depth_m), 0.5, depth_m,
                      kDimitriadis);
  }
  return {};
}

double layer_strain(const Indenter& indenter, double depth_m) noexcept {
  constexpr double kMostSphere = 0.5, kMostCone = 0.9;
  const ShapeRow& row = row_of(indenter.shape);
  if (!row.has_layer || !(depth_m > 0.0)) return 0.0;
  if (row.has_radius) return contact_over_layer(indenter, depth_m) / kMostSphere;
  return depth_m * std::tan(indenter.half_angle_rad) / indenter.layer_m / kMostCone;
}

}  // namespace afm::fits
