// SPDX-License-Identifier: Apache-2.0
#include "contact_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "curve_bins.h"

namespace afm::physics {

namespace {

enum class Indenter { Sphere, Cone };

// Two numbers that a processor adds or multiplies at once.
using Two = double __attribute__((vector_size(2 * sizeof(double))));

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
    return nodes()[place.node] + place.behind * (nodes()[place.node + 1] - nodes()[place.node]);
  }

  // Forces at the nodes, for a loop without checks.
  const double* nodes() const { return force_.data(); }

  // 0 outside the contact.
  double at(double depth) const { return depth <= 0.0 ? 0.0 : at(place_of(depth)); }

 private:
  static constexpr std::size_t kSteps = 128;
  static constexpr int kMostIterations = 20;
  std::array<double, kSteps + 1> force_{};
};

// The shapes for evenly spaced shares of the lever, 1 MB for both indenters, made once in some milliseconds: a search
// tries hundreds of shares.
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
    level_ = 1.0 / std::sqrt(count);
    tilt_.reserve(profile.z.size());
    for (const double z : profile.z) tilt_.push_back((z - middle) / std::sqrt(square));
    take_lines(rest_);
    for (const double rest : rest_) squares_ += rest * rest;
    inner_rest_.assign(rest_.rbegin(), rest_.rend());
    inner_tilt_.assign(tilt_.rbegin(), tilt_.rend());
  }

  double squares() const { return squares_; }

  // The points that touch, from the deepest one, if the contact is there.
  struct Places {
    std::vector<std::size_t> node;
    std::vector<double> behind;
  };
  void find_places(double contact, Places& places) const {
    const auto outside = std::find_if(profile_.z.rbegin(), profile_.z.rend(), [&](double z) { return !(z < contact); });
    const auto count = static_cast<std::size_t>(outside - profile_.z.rbegin());
    places.node.resize(count);
    places.behind.resize(count);
    const double per_depth = 1.0 / (contact - profile_.z.back());
    const double* z = profile_.z.data() + profile_.z.size();
    std::size_t* node = places.node.data();
    for (double& behind : places.behind) {
      const ForceShape::Place place = ForceShape::place_of((contact - *--z) * per_depth);
      *node++ = place.node;
      behind = place.behind;
    }
  }

  // Two points at once.
  double taken_by(const ForceShape& shape, const Places& places) const {
    const double* const nodes = shape.nodes();
    const std::size_t* const node = places.node.data();
    const std::size_t count = places.node.size();
    Two sum{}, squares{}, with_force{}, with_tilt{};
    const auto add = [&](const Two& force, const Two& rest, const Two& tilt) {
      sum += force;
      squares += force * force;
      with_force += force * rest;
      with_tilt += force * tilt;
    };
    const auto two_at = [](const std::vector<double>& values, std::size_t i) {
      const double* const here = values.data() + i;
      return Two{here[0], here[1]};
    };
    std::size_t i = 0;
    for (; i + 2 <= count; i += 2) {
      const double* const one = nodes + node[i];
      const double* const other = nodes + node[i + 1];
      const Two near{one[0], other[0]}, far{one[1], other[1]};
      add(near + two_at(places.behind, i) * (far - near), two_at(inner_rest_, i), two_at(inner_tilt_, i));
    }
    if (i < count) {
      add(Two{shape.at({node[i], places.behind[i]}), 0.0}, Two{inner_rest_[i], 0.0}, Two{inner_tilt_[i], 0.0});
    }
    const auto both = [](const Two& two) { return two[0] + two[1]; };
    const double with_level = both(sum) * level_, all = both(squares), push = both(with_force);
    const double own = all - with_level * with_level - both(with_tilt) * both(with_tilt);
    // a push, whose shape is not that of a line
    return push > 0.0 && own > 1e-9 * all ? push * push / own : 0.0;
  }

  // The best share of the lever: climbed to in steps, at last along a parabola. `near`: that of a neighbouring place,
  // if there is one, which is close to it; where it takes less than `hopeless`, it is taken as the best. `places` is
  // room to work in.
  PlaceFit best_at(double contact, Indenter indenter, std::optional<double> near, double hopeless,
                   Places& places) const {
    constexpr int kShares = ForceShapes::kShares, kFine = 8, kFiner = 4, kCoarse = kFine * kFiner * kFiner;
    PlaceFit best{-1.0, contact, 0.0, indenter};
    const ForceShapes& shapes = ForceShapes::of(indenter);
    find_places(contact, places);
    const auto taken = [&](int node) {
      const double value = taken_by(shapes.at(static_cast<std::size_t>(node)), places);
      if (value > best.taken) {
        best.taken = value;
        best.lever_share = static_cast<double>(node) / kShares;
      }
      return value;
    };
    if (near && taken(static_cast<int>(std::lround(*near * kShares))) < hopeless) return best;
    for (int step = near ? kFine : kCoarse;; step /= kFiner) {
      const double from = kShares * (best.taken < 0.0 ? 0.5 : best.lever_share);
      int middle = std::clamp(static_cast<int>(std::lround(from)), step, kShares - step);
      double below = taken(middle - step), here = taken(middle), above = taken(middle + step);
      while (above > here && middle + 2 * step <= kShares) {
        middle += step;
        below = std::exchange(here, above);
        above = taken(middle + step);
      }
      while (below > here && middle - 2 * step >= 0) {
        middle -= step;
        above = std::exchange(here, below);
        below = taken(middle - step);
      }
      if (step > kFine) continue;
      const double bent = below - 2.0 * here + above;
      if (bent < 0.0) {
        const double way = std::clamp(0.5 * (below - above) / bent, -1.0, 1.0);
        const int off = static_cast<int>(std::lround(way * step));
        if (off % step != 0) taken(middle + off);
      }
      return best;
    }
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
    double level = 0.0, tilt = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) level += values[i] * level_;
    for (double& value : values) value -= level * level_;
    for (std::size_t i = 0; i < values.size(); ++i) tilt += values[i] * tilt_[i];
    for (std::size_t i = 0; i < values.size(); ++i) values[i] -= tilt * tilt_[i];
  }

  const ApproachProfile& profile_;
  std::vector<double> rest_;
  double level_ = 0.0;                           // value of a constant line
  std::vector<double> tilt_;                     // a straight line; orthonormal with the constant one
  std::vector<double> inner_rest_, inner_tilt_;  // the same, from the deepest point
  double squares_ = 0.0;
};

// Fits at an even grid of places, then at finer ones around the best. Sphere and cone have separate optima. Of a place
// that fits much worse than the best the share is that of a neighbour: it is neither the best nor hardly worse.
std::vector<PlaceFit> fits_at_places(const Misfit& misfit, double low, double high) {
  constexpr int kPlaces = 64, kFirst = 8, kFiner = 4, kPasses = 4;
  constexpr double kMuchWorse = 16.0;  // ratio of sums of squares; a range has at most 4
  std::vector<PlaceFit> fits;
  fits.reserve(2 * (kPlaces + 1 + kPasses * 2 * (kFiner - 1)));
  double most = 0.0;  // taken by either
  Misfit::Places places;
  for (const Indenter indenter : {Indenter::Sphere, Indenter::Cone}) {
    PlaceFit best;
    const auto try_at = [&](double contact, const PlaceFit& neighbour) {
      const auto near = neighbour.taken > 0.0 ? std::optional(neighbour.lever_share) : std::nullopt;
      const double hopeless = misfit.squares() - kMuchWorse * (misfit.squares() - most);
      fits.push_back(misfit.best_at(std::clamp(contact, low, high), indenter, near, hopeless, places));
      if (fits.back().taken > best.taken) best = fits.back();
      most = std::max(most, best.taken);
      return fits.back();
    };
    double step = (high - low) / kPlaces;
    std::array<PlaceFit, kPlaces / kFirst + 1> firsts;
    for (std::size_t i = 0; i < firsts.size(); ++i)
      firsts[i] = try_at(low + static_cast<double>(i * kFirst) * step, {});
    for (std::size_t i = 0; i + 1 < firsts.size(); ++i) {
      PlaceFit last = firsts[i];
      for (std::size_t k = 1; k < kFirst; ++k) last = try_at(low + static_cast<double>(i * kFirst + k) * step, last);
    }
    for (int pass = 0; pass < kPasses; ++pass, step /= kFiner) {
      const PlaceFit middle = best;
      for (int i = 1 - kFiner; i < kFiner; ++i) {
        if (i != 0) try_at(middle.contact + i * step / kFiner, middle);
      }
    }
  }
  return fits;
}

}  // namespace

ApproachProfile profile_of(std::span<const CurvePoint> approach, std::size_t most_bins) {
  const auto [low, high] =
      std::minmax_element(approach.begin(), approach.end(), [](const auto& a, const auto& b) { return a.z < b.z; });
  const std::vector<MeanBin> bins = mean_bins(approach, low->z, high->z, most_bins);
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
