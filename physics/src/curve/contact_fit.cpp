// SPDX-License-Identifier: Apache-2.0
#include "contact_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "curve_bins.h"

namespace afm::physics {

namespace {

enum class Indenter { Sphere, Cone };

// Two numbers that a processor adds or multiplies in one instruction.
using Two = double __attribute__((vector_size(2 * sizeof(double))));

Two two_at(const double* values) {
  Two two;
  std::memcpy(&two, values, sizeof two);
  return two;
}

using TwoIntegers = std::int64_t __attribute__((vector_size(2 * sizeof(std::int64_t))));

// The bits of two numbers as integers.
TwoIntegers integers_in(const Two& two) {
  TwoIntegers bits;
  std::memcpy(&bits, &two, sizeof bits);
  return bits;
}

// Sums over the points in contact.
struct Sums {
  Two force{}, squares{}, with_rest{}, with_tilt{};

  void add(const Two& here, const Two& rest, const Two& tilt) {
    force += here;
    squares += here * here;
    with_rest += here * rest;
    with_tilt += here * tilt;
  }
};

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
        const double here = indenter == Indenter::Sphere ? root * half : root * root;
        const double slope = indenter == Indenter::Sphere ? 1.5 * half : 2.0 * root;
        const double step =
            ((1.0 - lever_share) * root + lever_share * here - depth) / (1.0 - lever_share + lever_share * slope);
        root -= step;
        if (step < 1e-12) break;
      }
      nodes_[node] = indenter == Indenter::Sphere ? root * std::sqrt(root) : root * root;
    }
  }

  // Two depths between nodes, the same for every shape.
  struct Places {
    TwoIntegers node{};
    Two behind{};  // distances from the nodes on the shallow side
  };
  static Places places_of(const Two& depth) {
    // added to this number, one is rounded to an integer, and its last bits are that integer
    constexpr double kRounds = 0x1.8p52;
    const Two one = depth < 1.0 ? depth : Two{1.0, 1.0}, place = one * static_cast<double>(kSteps);
    const Two least{kRounds, kRounds}, most = least + static_cast<double>(kSteps - 1);
    const Two below = place - 0.5 + kRounds, bounded = below < most ? below : most;
    const Two rounded = bounded > least ? bounded : least;
    return {integers_in(rounded) - integers_in(least), place - (rounded - kRounds)};
  }

  // Forces at the nodes, for a loop without checks.
  const double* nodes() const { return nodes_.data(); }

  // Force between two nodes.
  double at(std::int64_t node, double behind) const {
    const Two ends = two_at(nodes() + node);
    return ends[0] + behind * (ends[1] - ends[0]);
  }

  // Force at a depth, 0 outside the contact.
  double at(double depth) const {
    const Places place = places_of(Two{depth, depth});
    return depth <= 0.0 ? 0.0 : at(place.node[0], place.behind[0]);
  }

 private:
  static constexpr int kSteps = 128;
  static constexpr int kMostIterations = 20;
  std::array<double, kSteps + 1> nodes_{};
};

// The shapes for evenly spaced shares of the lever, 1 MB for both indenters, built once in some milliseconds: a search
// tries hundreds of shares.
class ForceShapes {
 public:
  static const ForceShapes& of(Indenter indenter) {
    static const ForceShapes sphere(Indenter::Sphere), cone(Indenter::Cone);
    return indenter == Indenter::Sphere ? sphere : cone;
  }

  static constexpr int kShares = 512;

  // The shape for a share in units of 1/kShares.
  const ForceShape& at(int share) const { return shapes_[static_cast<std::size_t>(share)]; }

 private:
  explicit ForceShapes(Indenter indenter) {
    shapes_.reserve(kShares + 1);
    for (int node = 0; node <= kShares; ++node) shapes_.emplace_back(indenter, static_cast<double>(node) / kShares);
  }

  std::vector<ForceShape> shapes_;
};

// Fit with the contact at one place.
struct PlaceFit {
  double taken = -1.0;  // reduction of the sum of squares; -1: no fit
  double contact = 0.0;
  int share = 0;  // the lever's share in units of 1/ForceShapes::kShares
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
    inner_z_.assign(profile.z.rbegin(), profile.z.rend());
    inner_z_.push_back(inner_z_.back());  // completes the last pair
  }

  double squares() const { return squares_; }

  // The points in contact, from the deepest one, if the contact is there.
  struct Places {
    std::vector<std::int64_t> node;
    std::vector<double> behind;
  };
  void find_places(double contact, Places& places) const {
    const auto outside = std::find_if(profile_.z.rbegin(), profile_.z.rend(), [&](double z) { return !(z < contact); });
    const auto count = static_cast<std::size_t>(outside - profile_.z.rbegin());
    places.node.resize(count);
    places.behind.resize(count);
    const double per_depth = 1.0 / (contact - profile_.z.back());
    const auto find = [&](std::size_t i, std::size_t pair) {
      const ForceShape::Places found = ForceShape::places_of((contact - two_at(inner_z_.data() + i)) * per_depth);
      std::memcpy(places.node.data() + i, &found.node, pair * sizeof(std::int64_t));
      std::memcpy(places.behind.data() + i, &found.behind, pair * sizeof(double));
    };
    std::size_t i = 0;
    for (; i + 2 <= count; i += 2) find(i, 2);
    if (i < count) find(i, 1);
  }

  // Four points at once, in two pairs with sums of their own: a sum waits for the addition before.
  double taken_by(const ForceShape& shape, const Places& places) const {
    const double* const nodes = shape.nodes();
    const std::int64_t* const node = places.node.data();
    const double* const behind = places.behind.data();
    const double* const rest = inner_rest_.data();
    const double* const tilt = inner_tilt_.data();
    const std::size_t count = places.node.size();
    Sums even, odd;
    const auto force_at = [&](std::size_t i) {
      const Two one = two_at(nodes + node[i]), other = two_at(nodes + node[i + 1]);
      const Two near = __builtin_shufflevector(one, other, 0, 2), far = __builtin_shufflevector(one, other, 1, 3);
      return near + two_at(behind + i) * (far - near);
    };
    std::size_t i = 0;
    for (; i + 4 <= count; i += 4) {
      even.add(force_at(i), two_at(rest + i), two_at(tilt + i));
      odd.add(force_at(i + 2), two_at(rest + i + 2), two_at(tilt + i + 2));
    }
    for (; i < count; ++i) {
      even.add(Two{shape.at(node[i], behind[i]), 0.0}, Two{rest[i], 0.0}, Two{tilt[i], 0.0});
    }
    const auto both = [](const Two& one, const Two& other) { return one[0] + one[1] + (other[0] + other[1]); };
    const double with_level = both(even.force, odd.force) * level_, all = both(even.squares, odd.squares);
    const double push = both(even.with_rest, odd.with_rest), with_tilt = both(even.with_tilt, odd.with_tilt);
    const double own = all - with_level * with_level - with_tilt * with_tilt;
    // a push, whose shape is not that of a line
    return push > 0.0 && own > 1e-9 * all ? push * push / own : 0.0;
  }

  // The best share of the lever: climbed to in steps, at last along a parabola. `near`: that of a neighbouring place,
  // if there is one, which is close to it; where it takes less than `hopeless`, it is taken as the best. `places` is
  // room to work in.
  PlaceFit best_at(double contact, Indenter indenter, std::optional<int> near, double hopeless, Places& places) const {
    constexpr int kShares = ForceShapes::kShares, kFine = 8, kFiner = 4, kCoarse = kFine * kFiner * kFiner;
    PlaceFit best{-1.0, contact, kShares / 2, indenter};
    const ForceShapes& shapes = ForceShapes::of(indenter);
    find_places(contact, places);
    const auto taken = [&](int share) {
      if (share == best.share && best.taken >= 0.0) return best.taken;
      const double value = taken_by(shapes.at(share), places);
      if (value > best.taken) {
        best.taken = value;
        best.share = share;
      }
      return value;
    };
    if (near && taken(*near) < hopeless) return best;
    for (int step = near ? kFine : kCoarse;; step /= kFiner) {
      int middle = std::clamp(best.share, step, kShares - step);
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
    const ForceShape& shape = ForceShapes::of(fit.indenter).at(fit.share);
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
  std::vector<double> tilt_;                     // tilted line; orthonormal with the constant one
  std::vector<double> inner_rest_, inner_tilt_;  // values of the points inside, from the deepest one
  std::vector<double> inner_z_;                  // heights of the points inside, plus one for a complete pair
  double squares_ = 0.0;
};

// Fits at an even grid of places, then at finer ones around the best. Sphere and cone have separate optima. Of a place
// that fits much worse than the best the share is that of a neighbour: it is neither the best nor hardly worse.
std::vector<PlaceFit> fits_at_places(const Misfit& misfit, double low, double high) {
  constexpr int kPlaces = 64, kFirst = 8, kFiner = 4, kPasses = 4;
  constexpr double kMuchWorse = 16.0;  // ratio of sums of squares; a range has at most 4
  std::vector<PlaceFit> fits;
  fits.reserve(2 * (kPlaces + 1 + kPasses * 2 * (kFiner - 1)));
  double most = 0.0;  // largest reduction by either indenter
  Misfit::Places places;
  for (const Indenter indenter : {Indenter::Sphere, Indenter::Cone}) {
    PlaceFit best;
    const auto try_at = [&](double contact, const PlaceFit& neighbour) {
      const auto near = neighbour.taken > 0.0 ? std::optional(neighbour.share) : std::nullopt;
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
  profile.z.reserve(bins.size());
  profile.force.reserve(bins.size());
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
