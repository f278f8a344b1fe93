// SPDX-License-Identifier: Apache-2.0
#include "island_push.h"

#include <algorithm>
#include <cmath>

#include "outline.h"
#include "physics/manipulation/island.h"

namespace afm::physics {
namespace {

constexpr double kIslandStepShare = 1.0 / 200.0;  // step size as a share of the distance of the axes
constexpr int kMostIslandSteps = 64;
// A base closer to the middle than this share of the distance of the axes: the tip is about to run over.
constexpr double kClosestIslandBase = 0.05;
constexpr double kYieldRounding = 1e-12;  // fraction by which a load must exceed a threshold
constexpr double kProbeWay = 1e-12;       // probe distance for the stiffness along the normal, m
constexpr int kTurnRounds = 3, kPlaceRounds = 3, kSlipRounds = 8, kReturnRounds = 40;

Flat across_normal(const Flat& normal) noexcept { return {-normal.y, normal.x}; }
double inner(const Flat& a, const Flat& b) noexcept { return a.x * b.x + a.y * b.y; }
// A unit vector rotated by a small angle.
Flat rotated_by(const Flat& unit, double angle_rad) noexcept {
  const double half = 0.5 * angle_rad;
  return turned(unit, half * (1.0 + half * half / 3.0));
}

class IslandWalk {
 public:
  IslandWalk(const LoneContact& contact, const IslandRim& rim, const IslandFriction& friction, double z_m) noexcept
      : contact_(contact), rim_(rim), friction_(friction), z_m_(z_m) {}

  IslandPath walk(const Flat& at, const std::optional<Flat>& normal, const Flat& from, const Flat& to) noexcept {
    path_.at = at;
    base_ = from;
    const Leaning touch = contact_.under(0.0, z_m_);
    rho_m_ = rim_.core_m + touch.base_m;
    if (!touch.holds) return path_;
    if (normal) {
      normal_ = *normal;
    } else if (!meet(to)) {
      return path_;
    }
    path_.met = touches_ = true;
    const Flat start = base_, way{to.x - start.x, to.y - start.y};
    const double needed = distance_between(start, to) / (kIslandStepShare * rho_m_);
    const int steps = std::clamp(static_cast<int>(std::ceil(std::min(needed, 1e6))), 1, kMostIslandSteps);
    for (int i = 1; i <= steps && touches_; ++i) {
      const double share = static_cast<double>(i) / steps;
      if (!step(i == steps ? to : Flat{start.x + share * way.x, start.y + share * way.y})) return path_;
    }
    path_.apex = {to.x, to.y, std::max(0.0, z_m_)};
    if (touches_) {
      const Flat across = across_normal(normal_);
      const double k_l = rim_.springs.lateral.si;
      path_.apex.x -= (force_.along_n * normal_.x + force_.across_n * across.x) / k_l;
      path_.apex.y -= (force_.along_n * normal_.y + force_.across_n * across.y) / k_l;
      path_.apex.height = contact_.under(force_.along_n, z_m_).apex_m;
    }
    path_.possible = true;
    return path_;
  }

 private:
  // The base goes on until tip and island touch. False if they do not; a base too far inside is refused later.
  bool meet(const Flat& to) noexcept {
    const double x = path_.at.x - base_.x, y = path_.at.y - base_.y, away_m = std::sqrt(x * x + y * y);
    if (away_m >= rho_m_) {
      const double way_m = distance_between(base_, to);
      if (!(way_m > 0.0)) return false;
      const Flat ahead{(to.x - base_.x) / way_m, (to.y - base_.y) / way_m};
      const double along_m = x * ahead.x + y * ahead.y;
      const double squares = rho_m_ * rho_m_ - (away_m * away_m - along_m * along_m);
      if (!(along_m > 0.0 && squares > 0.0)) return false;
      const double before_m = along_m - std::sqrt(squares);
      if (!(before_m < way_m)) return false;
      base_ = {base_.x + std::max(0.0, before_m) * ahead.x, base_.y + std::max(0.0, before_m) * ahead.y};
    }
    const double distance_m = distance_between(path_.at, base_);
    if (!(distance_m > 0.0)) {  // base exactly above the middle
      normal_ = {1.0, 0.0};
      return true;
    }
    normal_ = {(path_.at.x - base_.x) / distance_m, (path_.at.y - base_.y) / distance_m};
    return true;
  }

  double along_m() const noexcept { return inner(normal_, {path_.at.x - base_.x, path_.at.y - base_.y}); }

  RimForce force() const noexcept {
    const Flat lever{path_.at.x - base_.x, path_.at.y - base_.y};
    return {contact_.force_at(inner(normal_, lever) - rim_.core_m, z_m_),
            -rim_.springs.lateral.si * inner(across_normal(normal_), lever)};
  }

  double most_across_n(const RimForce& force) const noexcept { return rim_.tip_friction * force.along_n; }

  bool step(const Flat& to) noexcept {
    const Flat way{to.x - base_.x, to.y - base_.y};
    const double before_m = along_m();
    base_ = to;
    if (!(along_m() > kClosestIslandBase * rho_m_)) return false;
    const RimForce tried = force();
    if (tried.along_n < 0.0) return false;
    touches_ = tried.along_n > 0.0;
    if (!touches_) return true;
    const double most_n = most_across_n(tried);
    const RimForce borne{tried.along_n, std::clamp(tried.across_n, -most_n, most_n)};
    if (load_of(borne) <= friction_.holds_n * (1.0 + kYieldRounding)) return rest(tried);
    return slide(tried, borne, way, before_m);
  }

  // The island stays; the tip slips along its rim to where its friction bears the lever.
  bool rest(const RimForce& tried) noexcept {
    force_ = tried;
    const double k_l = rim_.springs.lateral.si, sign = tried.across_n < 0.0 ? -1.0 : 1.0;
    if (std::abs(tried.across_n) <= most_across_n(tried)) return true;
    const double x = path_.at.x - base_.x, y = path_.at.y - base_.y, away_m = std::sqrt(x * x + y * y);
    for (int i = 0; i < kSlipRounds; ++i) {
      const double sine = sign * most_across_n(force_) / (k_l * away_m);
      if (!(std::abs(sine) < 1.0)) return false;
      const double cosine = std::sqrt((1.0 - sine) * (1.0 + sine));
      normal_ = {(cosine * x - sine * y) / away_m, (cosine * y + sine * x) / away_m};
      force_ = force();
      if (!(force_.along_n > 0.0)) return false;
    }
    path_.lost_j += std::abs(force_.across_n) * (std::abs(tried.across_n) - std::abs(force_.across_n)) / k_l;
    return true;
  }

  // The island gives: back to the limit surface of f_k along its normal, with the normal of the contact at half of its
  // turn.
  bool slide(const RimForce& tried, const RimForce& borne, const Flat& way, double before_m) noexcept {
    const double k_l = rim_.springs.lateral.si, distance_m = before_m + friction_.moving_n / k_l;
    const double further_n = contact_.force_at(along_m() - kProbeWay - rim_.core_m, z_m_);
    const double k_n = (further_n - tried.along_n) / kProbeWay;
    if (!(further_n >= 0.0 && k_n > 0.0 && distance_m > 0.0)) return false;
    const double turns = kIslandArm2 * (before_m / distance_m);  // part of the turn that is motion across
    const Flat first = normal_, first_across = across_normal(normal_);
    Return to;
    double turn_rad = 0.0;  // angle by which the normal turns
    for (int i = 0; i < kTurnRounds; ++i) {
      const double half = 0.5 * turn_rad;
      to = returned(
          {tried.along_n + k_n * half * inner(first_across, way), tried.across_n - k_l * half * inner(first, way)}, k_n,
          k_l * (1.0 + turns), k_l);
      turn_rad = -(to.flow * kIslandArm2 * to.force.across_n + to.slip_m) / distance_m;
    }
    const Flat middle = rotated_by(first, 0.5 * turn_rad), across = across_normal(middle), was = path_.at;
    path_.at.x += to.flow * (to.force.along_n * middle.x + to.force.across_n * across.x);
    path_.at.y += to.flow * (to.force.along_n * middle.y + to.force.across_n * across.y);
    normal_ = rotated_by(first, turn_rad);
    // remainder of second order after the steps above
    for (int i = 0; i < kPlaceRounds; ++i) {
      force_ = force();
      if (!(force_.along_n > 0.0)) return false;
      const double nearer_m = (force_.along_n - to.force.along_n) / k_n;
      path_.at = {path_.at.x + nearer_m * normal_.x, path_.at.y + nearer_m * normal_.y};
      normal_ = rotated_by(normal_, (to.force.across_n - force_.across_n) / (k_l * along_m()));
    }
    force_ = force();
    const double turned_rad = -to.flow * kIslandArm2 * to.force.across_n / rim_.radius_m;
    path_.turned_rad += turned_rad;
    path_.lost_j += friction_.moving_n * island_way(distance_between(path_.at, was), turned_rad, rim_.radius_m) +
                    std::abs(to.force.across_n * to.slip_m);
    path_.moved = true;
    if (friction_.holds_n > friction_.moving_n) {
      ++path_.yields;
      path_.share = share_of_load(borne);
    }
    if (!friction_.ages_at_once) friction_.holds_n = friction_.moving_n;
    return true;
  }

  // Force on the limit surface of f_k. `flow` is the island's way over the force; `slip_m` is that of tip and rim.
  struct Return {
    RimForce force;
    double flow = 0.0, slip_m = 0.0;
  };
  Return returned(const RimForce& tried, double k_along, double k_across, double k_lever) const noexcept {
    const double f = friction_.moving_n, squares = 1.0 + kIslandArm2;
    Return to{.force = tried};
    // tip and rim stick: the excess is convex and falls with the flow
    for (int i = 0; i < kReturnRounds; ++i) {
      const double along = 1.0 + to.flow * k_along, across = 1.0 + to.flow * k_across;
      to.force = {tried.along_n / along, tried.across_n / across};
      const double n2 = to.force.along_n * to.force.along_n, t2 = squares * to.force.across_n * to.force.across_n;
      const double excess = n2 + t2 - f * f;
      if (excess <= 1e-15 * f * f) break;
      to.flow += excess / (2.0 * (n2 * k_along / along + t2 * k_across / across));
    }
    const double mu = rim_.tip_friction;
    if (std::abs(to.force.across_n) <= mu * to.force.along_n) return to;
    // it slips
    to.force.along_n = f / std::sqrt(1.0 + squares * mu * mu);
    to.force.across_n = std::copysign(mu * to.force.along_n, tried.across_n);
    to.flow = std::max(0.0, (tried.along_n / to.force.along_n - 1.0) / k_along);
    to.slip_m = (tried.across_n - to.force.across_n) / k_lever - to.flow * (k_across / k_lever) * to.force.across_n;
    return to;
  }

  const LoneContact& contact_;
  IslandRim rim_;
  IslandFriction friction_;
  double z_m_;
  IslandPath path_;
  Flat base_, normal_{1.0, 0.0};
  RimForce force_;
  double rho_m_ = 0.0;
  bool touches_ = false;
};

}  // namespace

double load_of(const RimForce& force) noexcept {
  return std::sqrt(force.along_n * force.along_n + (1.0 + kIslandArm2) * force.across_n * force.across_n);
}

double share_of_load(const RimForce& force) noexcept {
  const double load_n = load_of(force);
  if (!(load_n > 0.0)) return 1.0;
  return std::sqrt(force.along_n * force.along_n + force.across_n * force.across_n) / load_n;
}

IslandPath push_island(const LoneContact& contact, const IslandRim& rim, const IslandFriction& friction, const Flat& at,
                       const std::optional<Flat>& normal, const Flat& from, const Apex& to) noexcept {
  return IslandWalk(contact, rim, friction, to.height).walk(at, normal, from, {to.x, to.y});
}

}  // namespace afm::physics
