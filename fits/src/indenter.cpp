// SPDX-License-Identifier: Apache-2.0
#include "fits/indenter.h"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "physics/rows_of_enum.h"

namespace afm::fits {

namespace {

constexpr double kPi = std::numbers::pi;

// (F1): F = 4/3 E* sqrt(R) d^(3/2)
Push paraboloid(double radius_m, double depth_m) {
  const double slope = 2.0 * std::sqrt(radius_m * depth_m);
  return {2.0 / 3.0 * slope * depth_m, slope};
}

// (F2) in units of R and E*: with x = a/R, d/R = x artanh(x), F = (1 + x^2) artanh(x) - x, dF/dd = 2 x
Push unit_sphere(double depth) {
  double y = std::sqrt(depth * (1.0 + depth / 3.0)), x = 0.0;  // y = artanh(x), by Halley's method from above, and x
  for (int i = 0; i < 12; ++i) {
    x = std::tanh(y);
    const double square = (1.0 - x) * (1.0 + x);
    const double off = y * x - depth, first = x + y * square, second = 2.0 * square * (1.0 - y * x);
    const double step = 2.0 * off * first / (2.0 * first * first - off * second);
    y -= step;
    if (std::abs(step) < 1e-6 * y) break;
  }
  x = std::tanh(y);
  return {(1.0 + x * x) * y - x, 2.0 * x};
}

// Share of the paraboloid's slope that is left to the sphere, x/sqrt(t), for depths t from 0 to R: a polynomial of
// Chebyshev, since Newton's method would cost every point of a fit three hyperbolic tangents. The force is its
// integral.
class ShallowSphere {
 public:
  ShallowSphere() {
    constexpr auto kCount = static_cast<double>(kTerms);
    std::array<double, kTerms> shares{};
    for (std::size_t i = 0; i < kTerms; ++i) {
      const double t = 0.5 + 0.5 * std::cos(kPi * (static_cast<double>(i) + 0.5) / kCount);
      shares[i] = 0.5 * unit_sphere(t).slope / std::sqrt(t);
    }
    for (std::size_t k = 0; k < kTerms; ++k) {
      for (std::size_t i = 0; i < kTerms; ++i) {
        slope_[k] +=
            2.0 / kCount * shares[i] * std::cos(kPi * static_cast<double>(k) * (static_cast<double>(i) + 0.5) / kCount);
      }
    }
    // F = (4/3) t^1.5 g(t) has the slope 2 sqrt(t) [g + (2/3) t g']: solved in powers of t, term by term
    force_ = powers_of(slope_);
    slope_ = force_;
    for (std::size_t k = 0; k < kTerms; ++k) force_[k] = slope_[k] / (1.0 + 2.0 / 3.0 * static_cast<double>(k));
  }

  // Force and slope as shares of the paraboloid's.
  Push at(double t) const {
    Push share;
    for (std::size_t k = kTerms; k-- > 0;) {
      share.force = share.force * t + force_[k];
      share.slope = share.slope * t + slope_[k];
    }
    return share;
  }

 private:
  static constexpr std::size_t kTerms = 18;
  using Terms = std::array<double, kTerms>;

  // Coefficients in t of a polynomial in 2 t - 1.
  static Terms powers_of(const Terms& chebyshev) {
    Terms before{1.0}, now{-1.0, 2.0}, sum{};
    sum[0] = 0.5 * chebyshev[0];
    for (std::size_t k = 1; k < kTerms; ++k) {
      Terms next{};
      for (std::size_t p = 0; p < kTerms; ++p) {
        sum[p] += chebyshev[k] * now[p];
        next[p] = -2.0 * now[p] - before[p] + (p > 0 ? 4.0 * now[p - 1] : 0.0);
      }
      before = now;
      now = next;
    }
    return sum;
  }

  Terms force_{}, slope_{};
};

Push sphere(double radius_m, double depth_m) {
  static const ShallowSphere kShallow;
  const double t = depth_m / radius_m;
  if (t <= 1.0) {
    const Push flat = paraboloid(radius_m, depth_m), share = kShallow.at(t);
    return {flat.force * share.force, flat.slope * share.slope};
  }
  const Push deep = unit_sphere(t);
  return {radius_m * radius_m * deep.force, radius_m * deep.slope};
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

// The force of a thick sample times that of the table at the strain s, which grows like d^power.
Push in_exact_layer(const Push& thick, double s, double power, double depth_m, const LayerTable& table) {
  const LayerTable::Stiffening stiffer = table.at(s);
  return {thick.force * stiffer.factor,
          stiffer.factor * (thick.slope + thick.force * stiffer.slope * power * s / depth_m)};
}

constexpr std::array<double, 4> kGarciaSphere{1.133, 1.497, 1.469, 0.755};  // coefficients of (F4)
constexpr std::array<double, 4> kGarciaCone{0.721, 0.650, 0.491, 0.225};    // coefficients of (F5)

// (F6): the rounded coefficients of the paper, for a bonded layer of nu = 0.5
constexpr std::array<double, 4> kDimitriadis{1.133, 1.283, 0.769, 0.0975};

// Strain of a layer: contact radius, or depth for a sharp tip, over thickness.
double strain_of(const ShapeRow& row, const Indenter& indenter, double depth_m) {
  if (row.has_radius) return std::sqrt(indenter.radius_m * depth_m) / indenter.layer_m;
  return depth_m * std::tan(indenter.half_angle_rad) / indenter.layer_m;
}

}  // namespace

constexpr std::array<ShapeRow, 15> kShapes{{
    {Shape::Paraboloid, "paraboloid", true, false, false, false,
     "Hertz 1881, (4/3) E* sqrt(R) d^1.5; nanite's hertz_para", true},
    {Shape::Sphere, "sphere", true, false, false, false, "Sneddon 1965, exact", false},
    {Shape::Cone, "cone", false, false, false, false, "Sneddon 1965, (2/pi) tan(a) E* d^2", true, 2.0 / kPi},
    {Shape::Pyramid3, "pyramid3", false, false, false, false, "three faces, 0.8887 tan(a) E* d^2, as in nanite 4.2",
     true, 0.8887},
    {Shape::Pyramid4Bilodeau, "pyramid4-bilodeau", false, false, false, false,
     "four faces, 0.7453 tan(a) E* d^2, Bilodeau 1992", true, 0.7453},
    {Shape::Pyramid4Rico, "pyramid4-rico", false, false, false, false,
     "four faces, 0.7071 tan(a) E* d^2, Rico 2005, as in JPK's", true, 1.0 / std::numbers::sqrt2},
    {Shape::LayerSphere, "layer-sphere", true, true, false, false, "bonded layer, nu 0.5, Garcia & Garcia 2018", false,
     0.0, &kGarciaSphere},
    {Shape::LayerCone, "layer-cone", false, true, false, false, "bonded layer, nu 0.5, Garcia & Garcia 2018", false,
     2.0 / kPi, &kGarciaCone},
    {Shape::LayerExactSphere, "layer-exact-sphere", true, true, true, false,
     "layer of any nu and --base, exact, paraboloid", false},
    {Shape::LayerExactCone, "layer-exact-cone", false, true, true, false, "layer of any nu and --base, exact, cone",
     false, 2.0 / kPi},
    {Shape::LayerDimitriadis, "layer-dimitriadis", true, true, false, false,
     "bonded layer, nu 0.5, Dimitriadis 2002: biased, 5 % low at sqrt(R d)/h = 0.42", false, 0.0, &kDimitriadis},
    {Shape::Dmt, "dmt", true, false, false, true,
     "adhesion: Derjaguin, Muller & Toporov 1975, stiff samples; both branches", true},
    {Shape::Jkr, "jkr", true, false, false, true,
     "adhesion: Johnson, Kendall & Roberts 1971, soft samples; both branches", true},
    {Shape::Maugis, "maugis", true, false, false, true, "adhesion: Maugis 1992, between DMT and JKR; both branches",
     true},
    {Shape::Auto, "auto", true, false, false, true, "adhesion: dmt, maugis or jkr, by Tabor's parameter; both branches",
     true},
}};
static_assert(physics::has_row_for_each(kShapes, &ShapeRow::shape));

const ShapeRow& row_of(Shape shape) { return kShapes.at(static_cast<std::size_t>(shape)); }

Push push_of(const Indenter& indenter, double depth_m) noexcept {
  if (!(depth_m > 0.0)) return {};
  const ShapeRow& row = row_of(indenter.shape);
  if (!row.is_power && !row.has_layer) return sphere(indenter.radius_m, depth_m);
  const Push thick =
      row.has_radius ? paraboloid(indenter.radius_m, depth_m) : sharp(row.sharp, indenter.half_angle_rad, depth_m);
  if (!row.has_layer) return thick;
  const double strain = strain_of(row, indenter, depth_m), power = row.has_radius ? 0.5 : 1.0;
  return row.layer != nullptr ? in_layer(thick, strain, power, depth_m, *row.layer)
                              : in_exact_layer(thick, strain, power, depth_m, *indenter.table);
}

std::optional<PowerLaw> power_law_of(const Indenter& indenter) noexcept {
  constexpr double kUnitDepth = 1.0;
  const ShapeRow& row = row_of(indenter.shape);
  if (!row.is_power) return std::nullopt;
  return PowerLaw{!row.has_radius, push_of(indenter, kUnitDepth).force};
}

double layer_strain(const Indenter& indenter, double depth_m) noexcept {
  constexpr double kMostSphere = 0.5, kMostCone = 0.9;
  const ShapeRow& row = row_of(indenter.shape);
  if (!row.has_layer || !(depth_m > 0.0)) return 0.0;
  const double strain = strain_of(row, indenter, depth_m);
  if (row.is_exact) return strain / indenter.table->largest_strain();
  return strain / (row.has_radius ? kMostSphere : kMostCone);
}

std::shared_ptr<const LayerTable> exact_table(Shape shape, Base base, double poisson) {
  const Profile profile = row_of(shape).has_radius ? Profile::Paraboloid : Profile::Cone;
  return std::make_shared<const LayerTable>(profile, base, poisson);
}

}  // namespace afm::fits
