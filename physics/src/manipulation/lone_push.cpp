// SPDX-License-Identifier: Apache-2.0
#include "lone_push.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/manipulation/tip_hold.h"

namespace afm::physics {
namespace {

constexpr int kMostSlips = 64;
// A sphere closer to the base than this share of the tip's distance: the tip is about to run round it.
constexpr double kClosestBase = 0.05;
// Share of a distance by which rounding may place a sphere within its yield.
constexpr double kPlaceRounding = 1e-12;

// A base that moves along a straight line past one sphere.
class LoneWalk {
 public:
  LoneWalk(const LoneContact& contact, const LoneThresholds& thresholds, bool ages_at_once, double z_m)
      : contact_(contact), thresholds_(thresholds), ages_at_once_(ages_at_once), z_m_(z_m) {
    moving_ = contact.under(thresholds.moving_n, z_m);
  }

  LonePath walk(double threshold_n, const Flat& particle, const Flat& from, const Flat& to) noexcept {
    path_.particle = particle;
    base_ = from;
    const double x = to.x - from.x, y = to.y - from.y;
    left_m_ = std::sqrt(x * x + y * y);
    dx_ = left_m_ > 0.0 ? x / left_m_ : 0.0;
    dy_ = left_m_ > 0.0 ? y / left_m_ : 0.0;
    path_.possible = begin(threshold_n) && finish();
    return path_;
  }

 private:
  bool begin(double threshold_n) noexcept {
    const Leaning held = contact_.under(threshold_n, z_m_), touch = contact_.under(0.0, z_m_);
    if (!moving_.holds || !held.holds || !touch.holds || !(held.base_m > kClosestBase * touch.base_m)) return false;
    yield_n_ = threshold_n;
    yield_m_ = held.base_m;
    return settle(0.0);
  }

  bool finish() noexcept {
    for (int slips = 0; slips <= kMostSlips; ++slips) {
      const double before_m = way_to_yield();
      if (!(before_m <= left_m_)) return load(left_m_);
      if (!load(before_m) || !slip()) return false;
      const bool ages = ages_at_once_ && thresholds_.rest_n > thresholds_.moving_n;
      if (!ages) return slide();
    }
    return false;  // false: more slips than a sub-step may have
  }

  // Way until the lever pushes with the threshold; infinite if it never does.
  double way_to_yield() const noexcept {
    const double x = path_.particle.x - base_.x, y = path_.particle.y - base_.y;
    const double along_m = x * dx_ + y * dy_, away_m = std::sqrt(x * x + y * y);
    const double across2 = std::max(0.0, away_m * away_m - along_m * along_m);
    if (away_m <= yield_m_) return along_m > 0.0 || away_m < yield_m_ * (1.0 - kPlaceRounding) ? 0.0 : HUGE_VAL;
    if (yield_m_ * yield_m_ < across2) return HUGE_VAL;
    const double way_m = along_m - std::sqrt(yield_m_ * yield_m_ - across2);
    return way_m >= 0.0 ? way_m : HUGE_VAL;
  }

  void go(double way_m) noexcept {
    base_.x += way_m * dx_;
    base_.y += way_m * dy_;
    left_m_ -= way_m;
  }

  // Loads the lever while the sphere stays in place. False if the tip cannot go on.
  bool load(double way_m) noexcept {
    const double before_j = energy_j_;
    if (!settle(way_m)) return false;
    path_.given_j += energy_j_ - before_j;
    return true;
  }

  bool settle(double way_m) noexcept {
    go(way_m);
    const double x = path_.particle.x - base_.x, y = path_.particle.y - base_.y;
    const double lateral_n = contact_.force_at(std::sqrt(x * x + y * y), z_m_);
    if (lateral_n < 0.0) return false;
    energy_j_ = contact_.under(lateral_n, z_m_).energy_j;
    return true;
  }

  // The sphere jumps away until the lever pushes with f_k.
  bool slip() noexcept {
    const double x = path_.particle.x - base_.x, y = path_.particle.y - base_.y, u = std::sqrt(x * x + y * y);
    if (!(u > 0.0)) return false;
    if (moving_.base_m > u) {
      path_.particle = {base_.x + x / u * moving_.base_m, base_.y + y / u * moving_.base_m};
      path_.lost_j += energy_j_ - moving_.energy_j;
      energy_j_ = moving_.energy_j;
      path_.moved = true;
      if (yield_n_ > thresholds_.moving_n) ++path_.yields;
    }
    return true;
  }

  // The sphere goes before the base until the end of the path, or until the base passes it.
  bool slide() noexcept {
    const double x = path_.particle.x - base_.x, y = path_.particle.y - base_.y, u = std::sqrt(x * x + y * y);
    const double cosine = (x * dx_ + y * dy_) / u, sine = (y * dx_ - x * dy_) / u;
    if (!(cosine > 0.0) || !(left_m_ > 0.0)) return load(left_m_);
    const double r = moving_.base_m;
    const double half0 = sine / (1.0 + cosine);
    const double slide_m = half0 == 0.0 ? left_m_ : std::min(left_m_, -r * std::log(std::abs(half0)));
    const double half1 = half0 * std::exp(slide_m / r);
    const double turned = std::log1p(half1 * half1) - std::log1p(half0 * half0);
    const double travel_m = std::max(0.0, slide_m - r * turned);
    go(slide_m);
    const double scale = r / (1.0 + half1 * half1);
    const double forth = scale * (1.0 - half1 * half1), aside = scale * 2.0 * half1;
    path_.particle = {base_.x + forth * dx_ - aside * dy_, base_.y + forth * dy_ + aside * dx_};
    path_.given_j += thresholds_.moving_n * travel_m;
    path_.lost_j += thresholds_.moving_n * travel_m;
    path_.moved = path_.moved || travel_m > 0.0;
    return load(left_m_);
  }

  const LoneContact& contact_;
  LoneThresholds thresholds_;
  bool ages_at_once_;
  double z_m_;
  Leaning moving_;
  LonePath path_;
  Flat base_;
  double left_m_ = 0.0, dx_ = 0.0, dy_ = 0.0;
  double yield_n_ = 0.0, yield_m_ = 0.0;
  double energy_j_ = 0.0;
};

}  // namespace

LoneContact::LoneContact(const ParticleSpecies& species, const SphereCone& tip, const PushSprings& springs,
                         double tip_friction)
    : species_(species),
      springs_(springs),
      profile_(tip, species.contact.tip_radius),
      cap_z_m_(std::numeric_limits<double>::quiet_NaN()) {
  flank_grip_ = flank_grip(tip, species, tip_friction);
  cap_grip_ = {tip_friction, tip_pull_off(tip, species, false)};
  const double sine = profile_.flank_sine(), cosine = profile_.flank_cosine();
  const PushBalance rest = push_balance(species_, flank_grip_, sine, cosine);
  const PushBalance moving = push_balance(species_, flank_grip_, sine, cosine, species_.kinetic_ratio);
  flank_ = {rest.lateral.si, std::min(rest.lateral.si, moving.lateral.si), rest.mode};
}

Leaning LoneContact::under(double lateral_n, double z_m) const noexcept {
  const double k_c = springs_.normal.si, k_n = springs_.contact.si, k_l = springs_.lateral.si;
  double sine = profile_.flank_sine(), cosine = profile_.flank_cosine();
  double apex_m = std::max(0.0, z_m + lateral_n * sine / (cosine * k_c));
  double depth_m = lateral_n / (cosine * k_n);
  // the flank's contact passes to the cap where the undeformed bodies would, at an apex lower by the overlap
  const double crest_m = profile_.crest_height_m() - depth_m * sine;
  Leaning leaning;
  if (apex_m > crest_m && !lean_on_cap(lateral_n, z_m, std::max({0.0, z_m, crest_m}), apex_m, sine, cosine, depth_m)) {
    return leaning;
  }
  const double normal_n = lateral_n / cosine;
  // the distance of the axes at which the overlap is that of N
  const double clear_m = apex_m > crest_m ? (profile_.reach_sum_m() - depth_m) * cosine
                                          : profile_.flank_distance_m(apex_m) - depth_m / cosine;
  const double bent_m = apex_m - z_m;
  leaning.holds = true;
  leaning.base_m = clear_m - lateral_n / k_l;
  leaning.apex_m = apex_m;
  leaning.normal_n = normal_n;
  leaning.energy_j = 0.5 * (lateral_n * lateral_n / k_l + k_c * bent_m * bent_m + normal_n * normal_n / k_n);
  return leaning;
}

// Height at which the cap bears the force, k_c (h - Z) = F tan(phi(h)), from below: the left side less the right is
// concave in h, so that Newton's steps rise to its smallest root, if there is one.
bool LoneContact::lean_on_cap(double lateral_n, double z_m, double from_m, double& apex_m, double& sine, double& cosine,
                              double& depth_m) const noexcept {
  const double k_c = springs_.normal.si, k_n = springs_.contact.si, sum_m = profile_.reach_sum_m();
  apex_m = from_m;
  for (int i = 0; i < 60; ++i) {
    const double drop_m = apex_m + profile_.cap_offset_m();
    for (int inner = 0; inner < 8; ++inner) {  // search for the overlap that bears N at this height
      const double apart_m = sum_m - depth_m;
      if (!(drop_m < apart_m)) return false;
      sine = drop_m / apart_m;
      cosine = std::sqrt((1.0 - sine) * (1.0 + sine));
      const double next_m = lateral_n / (cosine * k_n);
      if (next_m == depth_m) break;
      depth_m = next_m;
    }
    if (!(depth_m < 0.5 * sum_m)) return false;
    const double lift_n = lateral_n * sine / cosine;
    const double missing_n = lift_n - k_c * (apex_m - z_m);
    // pressed on the sample by more than the cap lifts, or at rest
    if (missing_n <= 1e-15 * lift_n) return true;
    const double slope = k_c - lateral_n / (sum_m * cosine * cosine * cosine);
    if (!(slope > 0.0)) return false;
    const double next_m = apex_m + missing_n / slope;
    if (!(next_m > apex_m)) return true;
    apex_m = next_m;
  }
  return true;
}

double LoneContact::force_at(double base_m, double z_m) const noexcept {
  const Leaning touch = under(0.0, z_m);
  if (!touch.holds || base_m >= touch.base_m) return 0.0;
  // the lever alone bears more than lever and contact in series: a bracket
  double low = 0.0, high = (touch.base_m - base_m) * springs_.lateral.si;
  double low_m = touch.base_m - base_m;
  Leaning at = under(high, z_m);
  for (int i = 0; i < 60 && !at.holds; ++i) {  // search for a force that the tip bears
    high *= 0.5;
    at = under(high, z_m);
  }
  if (!at.holds) return -1.0;
  double high_m = at.base_m - base_m;
  if (high_m > 0.0) return -1.0;
  int side = 0;
  for (int i = 0; i < 100; ++i) {  // regula falsi, Illinois variant
    const double middle = (high * low_m - low * high_m) / (low_m - high_m);
    at = under(middle, z_m);
    const double gap_m = at.base_m - base_m;
    if (!(middle > low && middle < high) || std::abs(gap_m) <= 1e-16 * base_m) return middle;
    if (gap_m > 0.0) {
      low = middle;
      low_m = gap_m;
      if (side == 1) high_m *= 0.5;
      side = 1;
    } else {
      high = middle;
      high_m = gap_m;
      if (side == -1) low_m *= 0.5;
      side = -1;
    }
    if (high - low <= 2e-16 * high) break;
  }
  return 0.5 * (low + high);
}

LoneThresholds LoneContact::balanced(double sine, double cosine) const noexcept {
  const PushBalance rest = push_balance(species_, cap_grip_, sine, cosine);
  const PushBalance moving = push_balance(species_, cap_grip_, sine, cosine, species_.kinetic_ratio);
  return {rest.lateral.si, std::min(rest.lateral.si, moving.lateral.si), rest.mode};
}

LoneThresholds LoneContact::thresholds(double z_m) noexcept {
  const double cosine = profile_.flank_cosine(), sine = profile_.flank_sine();
  const double lifted_m = std::max(0.0, z_m + flank_.rest_n * sine / (cosine * springs_.normal.si));
  if (lifted_m <= profile_.crest_height_m() - flank_.rest_n * sine / (cosine * springs_.contact.si)) return flank_;
  if (z_m == cap_z_m_) return cap_;
  // the angle at which the cap bears the threshold determines the threshold
  cap_ = flank_;
  cap_z_m_ = z_m;
  LoneThresholds last = flank_;
  for (int i = 0; i < 40; ++i) {
    const Leaning rest = under(last.rest_n, z_m), moving = under(last.moving_n, z_m);
    if (!rest.holds || !moving.holds) break;
    const auto at = [&](const Leaning& leaning) {
      const double drop_m = leaning.apex_m + profile_.cap_offset_m();
      const double apart_m = profile_.reach_sum_m() - leaning.normal_n / springs_.contact.si;
      const double s = std::clamp(drop_m / apart_m, sine, 1.0 - 1e-12);
      return balanced(s, std::sqrt((1.0 - s) * (1.0 + s)));
    };
    const LoneThresholds next{at(rest).rest_n, at(moving).moving_n, at(rest).mode};
    const bool same = std::abs(next.rest_n - last.rest_n) <= 1e-11 * next.rest_n &&
                      std::abs(next.moving_n - last.moving_n) <= 1e-11 * next.moving_n;
    last = {next.rest_n, std::min(next.rest_n, next.moving_n), next.mode};
    if (same) break;
  }
  cap_ = last;
  return cap_;
}

LoneThresholds LoneContact::under_load(double normal_n, double sine, double cosine) const noexcept {
  const double slides_n = (normal_n < 0.0 ? threshold_under_pull(species_, Force(-normal_n * sine))
                                          : sliding_threshold(species_, Force(normal_n * sine)))
                              .si;
  if (!(species_.rolling_distance.si > 0.0) || !(normal_n > 0.0) || flank_.mode != PushMode::Rolls) {
    return {slides_n, species_.kinetic_ratio * slides_n, PushMode::Slides};
  }
  const double held_n = flank_grip_.coefficient * (normal_n + flank_grip_.adhesion.si);
  const Force load(normal_n * sine + held_n * cosine);
  const double rolls_n = rolling_moment(species_, load).si / species_.contact.tip_radius.si;
  return {rolls_n + held_n, species_.kinetic_ratio * rolls_n + held_n, PushMode::Rolls};
}

LonePath push_alone(const LoneContact& contact, const LoneThresholds& thresholds, double threshold_n, bool ages_at_once,
                    const Flat& particle, const Flat& from, const Flat& to, double z_m) noexcept {
  return LoneWalk(contact, thresholds, ages_at_once, z_m).walk(threshold_n, particle, from, to);
}

}  // namespace afm::physics
