// SPDX-License-Identifier: Apache-2.0
#include "contact_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "curve_bins.h"

namespace afm::physics {

namespace {

enum class Indenter { Sphere, Cone };

// Force as a share of that at the deepest point, by depth as a share of the deepest one: the inverse of
// x = (1 - s) g^(1/p) + s g, where s is the lever's share of the depth at the deepest point.
class ForceShape {
 public:
  ForceShape(Indenter indenter, double lever_share) {
    // from the deepest point on, Newton's method begins above the root of a convex function and stays there
    double root = 1.0;
    for (std::size_t node = kSteps; node > 0; --node) {
      const double depth = static_cast<double>(node) / kSteps;
      for (int i = 0; i < kMostIterations; ++i) {
        const double half = std::sqrt(root);
        const double force = indenter == Indenter::Sphere ? root * half : root * root;
        const double slope = indenter == Indenter::Sphere ? 1.5 * half : 2.0 * root;
        const double step =
            ((1.0 - lever_share) * root + lever_share * force - depth) / (1.0 - lever_share + lever_share * slope);
        root -= step;
        if (step < 1e-12) break;
      }
      force_[node] = indenter == Indenter::Sphere ? root * std::sqrt(root) : root * root;
    }
  }

  // A depth between two nodes, the same for every shape.
  struct Place {
    std::size_t node = 0;
    double behind = 0.0;  // distance from the node
  };
  static Place place_of(double depth) {
    const double place = std::min(depth, 1.0) * kSteps;
    const auto node = std::min(static_cast<std::size_t>(place), kSteps - 1);
    return {node, place - static_cast<double>(node)};
  }
  double at(const Place& place) const {
    return force_[place.node] + place.behind * (force_[place.node + 1] - force_[place.node]);
  }

  // 0 outside the contact.
  double at(double depth) const { return depth <= 0.0 ? 0.0 : at(place_of(depth)); }

 private:
  static constexpr std::size_t kSteps = 128;
  static constexpr int kMostIterations = 20;
  std::array<double, kSteps + 1> force_{};
};

// The shapes for evenly spaced shares of the lever, 1 MB for both indenters, made once in some milliseconds: a search
// at a hundred places tries 2000 shares.
class ForceShapes {
 public:
  static const ForceShapes& of(Indenter indenter) {
    static const ForceShapes sphere(Indenter::Sphere), cone(Indenter::Cone);
    return indenter == Indenter::Sphere ? sphere : cone;
  }

  static constexpr int kShares = 512;

  // The shape for a share in units of 1/kShares.
  const ForceShape& at(std::size_t share) const { return shapes_[share]; }

 private:
  explicit ForceShapes(Indenter indenter) {
    shapes_.reserve(kShares + 1);
    for (int node = 0; node <= kShares; ++node) shapes_.emplace_back(indenter, static_cast<double>(node) / kShares);
  }

  std::vector<ForceShape> shapes_;
};

// Fit with the contact at one place.
struct PlaceFit {
  double taken = -1.0;  // reduction of the sum of squares
  double contact = 0.0;
  double lever_share = 0.0;
  Indenter indenter = Indenter::Sphere;
};

// A profile without the straight line that fits it best.
class Misfit {
 public:
  explicit Misfit(const ApproachProfile& profile) : profile_(profile), rest_(profile.force) {
    const auto count = static_cast<double>(profile.z.size());
    double middle = 0.0, square = 0.0;
    for (const double z : profile.z) middle += z / count;
    for (const double z : profile.z) square += (z - middle) * (z - middle);
    for (const double z : profile.z) lines_.push_back({1.0 / std::sqrt(count), (z - middle) / std::sqrt(square)});
    take_lines(rest_);
    for (const double rest : rest_) squares_ += rest * rest;
  }

  double squares() const { return squares_; }

  // The points that touch, from the deepest one, if the contact is there.
  std::vector<ForceShape::Place> places_below(double contact) const {
    const double depth = contact - profile_.z.back();
    std::vector<ForceShape::Place> places;
    places.reserve(profile_.z.size());
    for (std::size_t end = profile_.z.size(); end > 0 && profile_.z[end - 1] < contact; --end) {
      places.push_back(ForceShape::place_of((contact - profile_.z[end - 1]) / depth));
    }
    return places;
  }

  double taken_by(const ForceShape& shape, const std::vector<ForceShape::Place>& places) const {
    double squares = 0.0, with_force = 0.0, with_level = 0.0, with_tilt = 0.0;
    std::size_t i = profile_.z.size();
    for (const ForceShape::Place& place : places) {
      --i;
      const double force = shape.at(place);
      squares += force * force;
      with_force += force * rest_[i];
      with_level += force * lines_[i][0];
      with_tilt += force * lines_[i][1];
    }
    const double own = squares - with_level * with_level - with_tilt * with_tilt;
    // a push, whose shape is not that of a line
    return with_force > 0.0 && own > 1e-9 * squares ? with_force * with_force / own : 0.0;
  }

  // The best share of the lever, by golden-section search.
  PlaceFit best_at(double contact, Indenter indenter) const {
    constexpr double kGolden = 0.618033988749895;
    constexpr int kSections = 13;  // to less than one of the shares
    PlaceFit best{-1.0, contact, 0.0, indenter};
    const ForceShapes& shapes = ForceShapes::of(indenter);
    const std::vector<ForceShape::Place> places = places_below(contact);
    std::array<double, kSections + 4> known{};  // values of the shares that were tried
    std::array<std::size_t, kSections + 4> tried{};
    std::size_t count = 0;
    const auto taken = [&](double share) {
      const auto node = static_cast<std::size_t>(std::lround(share * ForceShapes::kShares));
      for (std::size_t i = 0; i < count; ++i) {
        if (tried[i] == node) return known[i];
      }
      const double value = taken_by(shapes.at(node), places);
      tried[count] = node;
      known[count++] = value;
      if (value > best.taken) {
        best.taken = value;
        best.lever_share = static_cast<double>(node) / ForceShapes::kShares;
      }
      return value;
    };
    double low = 0.0, high = 1.0, left = 1.0 - kGolden, right = kGolden;
    taken(low);
    taken(high);
    double taken_left = taken(left), taken_right = taken(right);
    for (int i = 0; i < kSections; ++i) {
      if (taken_left > taken_right) {
        high = right;
        right = std::exchange(left, right - kGolden * (right - low));
        taken_right = std::exchange(taken_left, taken(left));
      } else {
        low = left;
        left = std::exchange(right, left + kGolden * (high - left));
        taken_left = std::exchange(taken_right, taken(right));
      }
    }
    return best;
  }

  // Number of independent residuals of a fit: of noise their number, of a wave its half periods.
  double independent_residuals(const PlaceFit& fit) const {
    const ForceShape shape(fit.indenter, fit.lever_share);
    const double depth = fit.contact - profile_.z.back();
    std::vector<double> force;
    force.reserve(profile_.z.size());
    for (const double z : profile_.z) force.push_back(shape.at((fit.contact - z) / depth));
    take_lines(force);
    double squares = 0.0, with_rest = 0.0;
    for (std::size_t i = 0; i < force.size(); ++i) {
      squares += force[i] * force[i];
      with_rest += force[i] * rest_[i];
    }
    const double factor = squares > 0.0 ? with_rest / squares : 0.0;
    double runs = 1.0, before = 0.0;
    for (std::size_t i = 0; i < force.size(); ++i) {
      const double residual = rest_[i] - factor * force[i];
      if (residual * before < 0.0) runs += 1.0;
      before = residual;
    }
    const auto count = static_cast<double>(force.size());
    return std::clamp(runs * (1.0 + 2.0 * runs / count), 3.0, count);
  }

 private:
  void take_lines(std::vector<double>& values) const {
    for (std::size_t line = 0; line < 2; ++line) {
      double part = 0.0;
      for (std::size_t i = 0; i < values.size(); ++i) part += values[i] * lines_[i][line];
      for (std::size_t i = 0; i < values.size(); ++i) values[i] -= part * lines_[i][line];
    }
  }

  const ApproachProfile& profile_;
  std::vector<double> rest_;
  std::vector<std::array<double, 2>> lines_;  // level and tilt, orthonormal
  double squares_ = 0.0;
};

// Fits at an even grid of places, then at finer ones around the best. Sphere and cone have separate optima.
std::vector<PlaceFit> fits_at_places(const Misfit& misfit, double low, double high) {
  constexpr int kPlaces = 64, kFiner = 4, kPasses = 4;
  std::vector<PlaceFit> fits;
  for (const Indenter indenter : {Indenter::Sphere, Indenter::Cone}) {
    PlaceFit best;
    const auto try_at = [&](double contact) {
      fits.push_back(misfit.best_at(std::clamp(contact, low, high), indenter));
      if (fits.back().taken > best.taken) best = fits.back();
    };
    double step = (high - low) / kPlaces;
    for (int i = 0; i <= kPlaces; ++i) try_at(low + i * step);
    for (int pass = 0; pass < kPasses; ++pass, step /= kFiner) {
      const double middle = best.contact;
      for (int i = -kFiner; i <= kFiner; ++i) try_at(middle + i * step / kFiner);
    }
  }
  return fits;
}

}  // namespace

ApproachProfile profile_of(std::span<const CurvePoint> approach, std::size_t most_bins) {
  const auto [low, high] =
      std::minmax_element(approach.begin(), approach.end(), [](const auto& a, const auto& b) { return a.z < b.z; });
  std::vector<CurveBin> bins = curve_bins(approach, low->z, high->z, most_bins, 1);
  const auto greatest =
      std::max_element(bins.begin(), bins.end(), [](const auto& a, const auto& b) { return a.mean < b.mean; });
  ApproachProfile profile;
  for (auto bin = bins.end(); bin != greatest;) {
    --bin;
    profile.z.push_back(bin->z.si);
    profile.force.push_back(bin->mean.si);
  }
  return profile;
}

ContactFit fit_contact(const ApproachProfile& profile) {
  constexpr double kSignificant = 9.0, kFewestBins = 3.0, kMostApart = 0.17, kLeastOutside = 0.18;
  const std::size_t count = profile.z.size();
  const double outermost = profile.z.front(), deepest = profile.z.back(), way = outermost - deepest;
  const Misfit misfit(profile);
  // a contact has at least two bins
  const std::vector<PlaceFit> fits = fits_at_places(misfit, profile.z[count - 2], outermost);
  const PlaceFit& best =
      *std::max_element(fits.begin(), fits.end(), [](const auto& a, const auto& b) { return a.taken < b.taken; });

  const double least = misfit.squares() - best.taken;
  const double limit = least * (1.0 + kSignificant / misfit.independent_residuals(best));
  ContactFit result{best.contact, best.contact, best.contact};
  for (const PlaceFit& fit : fits) {
    if (misfit.squares() - fit.taken > limit) continue;
    result.low = std::min(result.low, fit.contact);
    result.high = std::max(result.high, fit.contact);
  }
  const double bin = way / static_cast<double>(count);
  result.low -= 0.5 * bin;
  result.high += 0.5 * bin;
  result.lacks_baseline = outermost - best.contact < kLeastOutside * way;
  result.doubtful = result.lacks_baseline ||
                    result.high - result.low > std::max(kMostApart * (best.contact - deepest), kFewestBins * bin);
  return result;
}

}  // namespace afm::physics
