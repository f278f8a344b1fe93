// SPDX-License-Identifier: Apache-2.0
#include "fits/layer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace afm::fits {

namespace {

constexpr std::size_t kNodes = 32;          // Gauss-Legendre nodes on the radius of the contact
constexpr double kWidest = 3.0;             // largest contact radius over the thickness
constexpr std::size_t kRadii = 160;         // number of tabulated contact radii
constexpr std::size_t kKernelPoints = 800;  // grid points of the kernel, on twice that radius

// Nodes and weights on 0 to 1, by Newton's method on the Legendre polynomial.
struct Gauss {
  std::vector<double> nodes, weights;

  explicit Gauss(std::size_t count) : nodes(count), weights(count) {
    for (std::size_t i = 0; i < count; ++i) {
      double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (static_cast<double>(count) + 0.5)),
             slope = 0.0;
      for (int step = 0; step < 20; ++step) {
        double before = 1.0, now = x;
        for (std::size_t k = 2; k <= count; ++k) {
          const auto order = static_cast<double>(k);
          before = std::exchange(now, ((2.0 * order - 1.0) * x * now - (order - 1.0) * before) / order);
        }
        slope = static_cast<double>(count) * (x * now - before) / (x * x - 1.0);
        x -= now / slope;
      }
      nodes[i] = 0.5 * (1.0 - x);
      weights[i] = 1.0 / ((1.0 - x * x) * slope * slope);
    }
  }
};

// 1 - L(x), which falls like exp(-2 x): what the base adds to a half space at the wave number x/h.
double missing(Base base, double nu, double x) {
  // numerator and denominator times 2 exp(-2 x), so that neither overflows
  const double fall = std::exp(-2.0 * x), square = fall * fall;
  if (base == Base::Sliding) {
    const double denominator = 1.0 - square + 4.0 * x * fall;
    return denominator > 0.0 ? (2.0 * fall - 2.0 * square + 4.0 * x * fall) / denominator : 1.0;
  }
  const double k = 3.0 - 4.0 * nu, rest = 2.0 * x * x + 5.0 - 12.0 * nu + 8.0 * nu * nu;
  return (2.0 * k * square + 2.0 * fall * (rest + 2.0 * x)) / (k * (1.0 + square) + 2.0 * fall * rest);
}

// k(v), the cosine transform of 1 - L, on an even grid; in between by a cubic through four points.
class Kernel {
 public:
  Kernel(Base base, double nu) : values_(kKernelPoints + 3) {
    constexpr double kEnd = 24.0;  // wave number at which 1 - L is below 1e-18
    const Gauss gauss(160);
    std::vector<double> shares;
    shares.reserve(gauss.nodes.size());
    for (const double node : gauss.nodes) shares.push_back(missing(base, nu, kEnd * node));
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const double v = static_cast<double>(i) * kStep;
      for (std::size_t q = 0; q < gauss.nodes.size(); ++q) {
        values_[i] += kEnd * gauss.weights[q] * shares[q] * std::cos(kEnd * gauss.nodes[q] * v);
      }
    }
  }

  double at(double v) const {
    const double place = std::abs(v) / kStep;
    const auto i = std::min(static_cast<std::size_t>(place), kKernelPoints);
    const double t = place - static_cast<double>(i);
    const double before = i > 0 ? values_[i - 1] : values_[1];  // mirrored value, because the function is even
    const double a = values_[i], b = values_[i + 1], after = values_[i + 2];
    return a + 0.5 * t *
                   (b - before + t * (2.0 * before - 5.0 * a + 4.0 * b - after + t * (3.0 * (a - b) + after - before)));
  }

 private:
  static constexpr double kStep = 2.0 * kWidest / static_cast<double>(kKernelPoints);
  std::vector<double> values_;
};

// Solves the dense system for two right-hand sides, by elimination with pivots; each row has them at its end.
void solve(std::vector<std::vector<double>>& rows) {
  const std::size_t n = rows.size();
  for (std::size_t pivot = 0; pivot < n; ++pivot) {
    const auto largest =
        std::max_element(rows.begin() + static_cast<std::ptrdiff_t>(pivot), rows.end(),
                         [&](const auto& a, const auto& b) { return std::abs(a[pivot]) < std::abs(b[pivot]); });
    std::iter_swap(rows.begin() + static_cast<std::ptrdiff_t>(pivot), largest);
    for (std::size_t row = 0; row < n; ++row) {
      if (row == pivot) continue;
      const double factor = rows[row][pivot] / rows[pivot][pivot];
      for (std::size_t column = pivot; column < n + 2; ++column) rows[row][column] -= factor * rows[pivot][column];
    }
  }
}

// Strain and logarithm of the factor for a contact of `radius` thicknesses.
struct Point {
  double strain = 0, log_factor = 0;
};

// (F9) with t = a tau: phi(tau) - (radius/pi) int phi(sigma) [k(radius (tau - sigma)) + k(radius (tau + sigma))] = 1
// for the depth, and tau^2 or tau for the tip's profile; the pressure vanishes at the rim, phi(1) = 0.
Point solved(const Kernel& kernel, const Gauss& gauss, Profile profile, double radius) {
  const auto tip = [&](double tau) { return profile == Profile::Paraboloid ? tau * tau : tau; };
  const auto weight = [&](double tau, std::size_t j) {
    const double sigma = gauss.nodes[j];
    return radius / std::numbers::pi * gauss.weights[j] *
           (kernel.at(radius * (tau - sigma)) + kernel.at(radius * (tau + sigma)));
  };
  std::vector<std::vector<double>> rows(kNodes, std::vector<double>(kNodes + 2));
  for (std::size_t i = 0; i < kNodes; ++i) {
    for (std::size_t j = 0; j < kNodes; ++j) rows[i][j] = (i == j ? 1.0 : 0.0) - weight(gauss.nodes[i], j);
    rows[i][kNodes] = 1.0;
    rows[i][kNodes + 1] = tip(gauss.nodes[i]);
  }
  solve(rows);
  // at the rim by the equation itself; mean values over the radius
  double rim_depth = 1.0, rim_tip = tip(1.0), mean_depth = 0.0, mean_tip = 0.0;
  for (std::size_t j = 0; j < kNodes; ++j) {
    const double depth = rows[j][kNodes] / rows[j][j], shape = rows[j][kNodes + 1] / rows[j][j];
    rim_depth += weight(1.0, j) * depth;
    rim_tip += weight(1.0, j) * shape;
    mean_depth += gauss.weights[j] * depth;
    mean_tip += gauss.weights[j] * shape;
  }
  // depth in units of the tip's profile at the rim of the contact, and force in units of E* a times it
  const double depth = rim_tip / rim_depth, force = 2.0 * (depth * mean_depth - mean_tip);
  if (profile == Profile::Paraboloid) {
    return {radius * std::sqrt(depth), std::log(0.75 * force / std::pow(depth, 1.5))};
  }
  return {0.5 * std::numbers::pi * radius * depth, std::log(force / (depth * depth))};
}

}  // namespace

LayerTable::LayerTable(Profile profile, Base base, double poisson) {
  if (!(poisson >= 0.0 && poisson <= 0.5)) throw std::invalid_argument("a layer's Poisson ratio is 0 to 0.5");
  const Kernel kernel(base, poisson);
  const Gauss gauss(kNodes);
  strains_.push_back(0.0);
  logs_.push_back(0.0);
  for (std::size_t i = 1; i <= kRadii; ++i) {
    const Point point = solved(kernel, gauss, profile, kWidest * static_cast<double>(i) / static_cast<double>(kRadii));
    strains_.push_back(point.strain);
    logs_.push_back(point.log_factor);
  }
  // derivatives by the parabola through three neighbours
  const std::size_t n = strains_.size();
  slopes_.resize(n);
  const auto steep = [&](std::size_t i) { return (logs_[i + 1] - logs_[i]) / (strains_[i + 1] - strains_[i]); };
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double left = strains_[i] - strains_[i - 1], right = strains_[i + 1] - strains_[i];
    slopes_[i] = (steep(i - 1) * right + steep(i) * left) / (left + right);
  }
  slopes_[0] = 2.0 * steep(0) - slopes_[1];
  slopes_[n - 1] = 2.0 * steep(n - 2) - slopes_[n - 2];
}

LayerTable::Stiffening LayerTable::at(double strain) const noexcept {
  if (!(strain > 0.0)) return {1.0, slopes_.front()};
  const auto above = std::upper_bound(strains_.begin(), strains_.end(), strain);
  if (above == strains_.end()) {
    return {std::exp(logs_.back() + slopes_.back() * (strain - strains_.back())), slopes_.back()};
  }
  // a cubic with the values and slopes at both ends
  const auto i = static_cast<std::size_t>(above - strains_.begin()) - 1;
  const double width = strains_[i + 1] - strains_[i], t = (strain - strains_[i]) / width;
  const double rise = logs_[i + 1] - logs_[i];
  const double a = slopes_[i] * width - rise, b = rise - slopes_[i + 1] * width;
  const double log = logs_[i] + t * rise + t * (1.0 - t) * (a * (1.0 - t) + b * t);
  const double slope = rise + (1.0 - 2.0 * t) * (a * (1.0 - t) + b * t) + t * (1.0 - t) * (b - a);
  return {std::exp(log), slope / width};
}

}  // namespace afm::fits
