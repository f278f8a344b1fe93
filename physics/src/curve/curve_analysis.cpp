// SPDX-License-Identifier: Apache-2.0
#include "physics/curve_analysis.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>

#include "baseline.h"
#include "contact_fit.h"
#include "retract_features.h"

namespace afm::physics {

namespace {

// A feature is significant from five standard deviations of the noise on; without noise, from kRoundingShare of the
// curve's largest force on.
constexpr double kSignificant = 5.0;

// Searches the points before contact.
std::optional<CurveJump> find_snap_in(std::span<const CurvePoint> before_contact, Force threshold) {
  if (before_contact.size() < 2) return std::nullopt;
  const auto lowest =
      static_cast<std::size_t>(std::min_element(before_contact.begin(), before_contact.end(),
                                                [](const auto& a, const auto& b) { return a.force < b.force; }) -
                               before_contact.begin());
  const Force pull = -before_contact[lowest].force;
  if (pull <= threshold) return std::nullopt;

  const auto fall = [&](std::size_t i) { return before_contact[i].force - before_contact[i + 1].force; };
  std::size_t start = 0;
  for (std::size_t i = 0; i < lowest; ++i) {
    if (fall(i) > fall(start)) start = i;
  }
  if (lowest == 0 || fall(start) <= threshold || fall(start) < 0.25 * pull) return std::nullopt;

  // a jump may be spread over several samples of a filtered signal
  const Force steep = 0.25 * fall(start);
  while (start > 0 && fall(start - 1) > steep) --start;
  return CurveJump{before_contact[start].z, before_contact[start].force, -pull};
}

std::optional<Stiffness> slope_of_upper_half(std::span<const CurvePoint> approach, Force greatest_push) {
  double count = 0, mean_z = 0, mean_force = 0;
  const auto upper = [&](const CurvePoint& point) { return point.force >= 0.5 * greatest_push; };
  for (const CurvePoint& point : approach) {
    if (!upper(point)) continue;
    count += 1;
    mean_z += (point.z.si - mean_z) / count;
    mean_force += (point.force.si - mean_force) / count;
  }
  double zz = 0, zf = 0;
  for (const CurvePoint& point : approach) {
    if (!upper(point)) continue;
    zz += (point.z.si - mean_z) * (point.z.si - mean_z);
    zf += (point.z.si - mean_z) * (point.force.si - mean_force);
  }
  if (count < 3 || zz <= 0.0) return std::nullopt;
  return Stiffness(-zf / zz);
}

// Pull before contact, relative to the push, that exceeds an undulation of the baseline.
constexpr double kPullShareOfPush = 0.05;

std::optional<Length> estimate_of(const CurveFeatures& features, ContactMethod method) {
  for (std::size_t i = 0; i < kContactMethods.size(); ++i) {
    if (kContactMethods[i].method == method) return features.contact_estimates[i];
  }
  return std::nullopt;
}

void widen(Length place, PlaceRange& range) { range = {std::min(range.low, place), std::max(range.high, place)}; }

// The bins before contact above the straight line that fits them, from the outermost inwards: the baseline of the
// outermost bins alone may lean on a wave.
std::vector<double> levelled_outside(const ApproachProfile& profile, Length contact) {
  std::vector<double> force;
  double z = 0.0, mean = 0.0, zz = 0.0, zf = 0.0;
  const auto inner = std::find_if(profile.z.begin(), profile.z.end(), [&](double place) { return place < contact.si; });
  const auto count = static_cast<std::size_t>(inner - profile.z.begin());
  for (std::size_t i = 0; i < count; ++i) {
    z += profile.z[i] / static_cast<double>(count);
    mean += profile.force[i] / static_cast<double>(count);
  }
  for (std::size_t i = 0; i < count; ++i) {
    zz += (profile.z[i] - z) * (profile.z[i] - z);
    zf += (profile.z[i] - z) * (profile.force[i] - mean);
  }
  force.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    force.push_back(profile.force[i] - mean - (zz > 0.0 ? zf / zz : 0.0) * (profile.z[i] - z));
  }
  return force;
}

// Outwards from the strongest pull before contact, the force rises and stays there; a wave of the baseline falls again.
bool is_attracted(const ApproachProfile& profile, Length contact) {
  const std::vector<double> force = levelled_outside(profile, contact);
  if (force.empty()) return false;
  const auto strongest = static_cast<std::size_t>(std::min_element(force.begin(), force.end()) - force.begin());
  double highest = force[strongest], fall = 0.0;
  for (std::size_t i = strongest + 1; i-- > 0;) {
    highest = std::max(highest, force[i]);
    fall = std::max(fall, highest - force[i]);
  }
  return fall < 0.5 * (highest - force[strongest]);
}

// Every method's place; the fit's own range in addition. Empty without a fit.
std::optional<ContactFit> estimate_contact(std::span<const CurvePoint> approach, const ApproachProfile& profile,
                                           CurveFeatures& features) {
  std::optional<ContactFit> fit;
  if (profile.z.size() >= kFewestFitBins) fit = fit_contact(profile);
  const ApproachProfile fine = profile_of(approach);
  for (std::size_t i = 0; i < kContactMethods.size(); ++i) {
    const ContactMethod method = kContactMethods[i].method;
    if (method == ContactMethod::ZeroForce) {
      features.contact_estimates[i] = contact_point(approach, method);
    } else if (method == ContactMethod::FitPolynomial) {
      if (fit) features.contact_estimates[i] = Length(fit->contact);
    } else if (const auto z = contact_on(fine, method)) {
      features.contact_estimates[i] = Length(*z);
    }
  }
  return fit;
}

// Finds the contact point of an approach with a push.
void find_contact(std::span<const CurvePoint> approach, Force threshold, ForceZero zero_of_force,
                  std::optional<ContactMethod> method, CurveFeatures& features) {
  const ApproachProfile profile = profile_of(approach, kMostFitBins);
  const std::optional<ContactFit> fit = estimate_contact(approach, profile, features);
  const auto zero = estimate_of(features, ContactMethod::ZeroForce);
  const auto deepest_push = std::max_element(approach.begin(), approach.end(),
                                             [](const auto& a, const auto& b) { return a.force < b.force; });
  const auto outside = zero ? std::find_if(std::make_reverse_iterator(deepest_push), approach.rend(),
                                           [&](const CurvePoint& point) { return point.z >= *zero; })
                                  .base()
                            : approach.end();
  const auto before_contact = approach.first(static_cast<std::size_t>(outside - approach.begin()));
  features.snap_in = find_snap_in(before_contact, threshold);
  Force pull;
  for (const CurvePoint& point : before_contact) pull = std::max(pull, -point.force);
  const bool pulled =
      zero && (zero_of_force == ForceZero::True || features.snap_in ||
               (pull > std::max(threshold, kPullShareOfPush * features.greatest_push) && is_attracted(profile, *zero)));
  features.contact_method = method.value_or(pulled ? ContactMethod::ZeroForce : ContactMethod::FitPolynomial);
  features.contact_point = estimate_of(features, features.contact_method);
  if (!features.contact_point) return;
  features.contact_range = PlaceRange{*features.contact_point, *features.contact_point};
  for (const auto& estimate : features.contact_estimates) {
    if (estimate) widen(*estimate, *features.contact_range);
  }
  const Length deepest =
      std::min_element(approach.begin(), approach.end(), [](const auto& a, const auto& b) { return a.z < b.z; })->z;
  const auto agrees = [&](Length place) {
    return abs(place - *features.contact_point) <= (*features.contact_point - deepest) / 3.0;
  };
  if (pulled) {
    // a wave, or the misfit of a missing baseline, may look like an attraction
    const bool gradual = zero_of_force == ForceZero::Instrument && !features.snap_in;
    features.contact_doubtful = gradual && fit && (fit->lacks_baseline || !agrees(Length(fit->contact)));
    return;
  }
  if (fit) {
    widen(Length(fit->low), *features.contact_range);
    widen(Length(fit->high), *features.contact_range);
  }

  const auto agreeing =
      std::count_if(kContactMethods.begin(), kContactMethods.end(), [&](const ContactMethodName& each) {
        const auto estimate = estimate_of(features, each.method);
        return each.method != ContactMethod::ZeroForce && estimate && agrees(*estimate);
      });
  features.contact_doubtful = agreeing < 4 || !fit || fit->doubtful;
}

}  // namespace

CurveSummary summarise(std::span<const CurveSample> samples) {
  CurveSummary summary;
  const CurveSample* previous = nullptr;
  for (const CurveSample& sample : samples) {
    Extreme& extreme = sample.branch == Branch::Approach ? summary.approach : summary.retract;
    if (sample.force < extreme.force) extreme = {sample.z, sample.force};
    if (previous != nullptr) {
      summary.loop_energy = summary.loop_energy - 0.5 * (sample.force + previous->force) * (sample.z - previous->z);
    }
    previous = &sample;
  }
  return summary;
}

std::vector<CurvePoint> points_of(std::span<const CurveSample> samples) {
  std::vector<CurvePoint> points;
  points.reserve(samples.size());
  for (const CurveSample& sample : samples) points.push_back({sample.z, sample.force, sample.branch});
  return points;
}

CurveFeatures analyse(std::span<const CurvePoint> points, ForceZero zero_of_force, std::optional<ContactMethod> method,
                      const BaselineChoice& choice) {
  std::vector<CurvePoint> cycle(points.begin(), points.end());
  const auto turn = std::stable_partition(cycle.begin(), cycle.end(),
                                          [](const CurvePoint& point) { return point.branch == Branch::Approach; });
  const auto approach_count = static_cast<std::size_t>(turn - cycle.begin());
  if (approach_count < kFewestApproachPoints) {
    throw std::invalid_argument("the curve's approach has " + std::to_string(approach_count) +
                                " points; an analysis needs at least " + std::to_string(kFewestApproachPoints));
  }
  Force greatest;
  for (const CurvePoint& point : cycle) {
    if (!isfinite(point.z) || !isfinite(point.force)) throw std::invalid_argument("a point of the curve is not finite");
    greatest = std::max(greatest, abs(point.force));
  }

  CurveFeatures features;
  const std::span<CurvePoint> approach(cycle.data(), approach_count);
  features.baseline = fit_baseline(approach, greatest, choice);
  if (zero_of_force == ForceZero::True) {
    features.baseline.level = Force();
    features.baseline.tilt = Stiffness();
    features.baseline.waves = {};
  }
  for (CurvePoint& point : cycle) {
    point.force = point.force - features.baseline.at(point.z);
    if (point.branch == Branch::Approach) features.greatest_push = std::max(features.greatest_push, point.force);
  }
  const Force threshold = std::max(kSignificant * features.baseline.noise, kRoundingShare * greatest);

  if (features.greatest_push > threshold) {
    find_contact(approach, threshold, zero_of_force, method, features);
    features.contact_slope = slope_of_upper_half(approach, features.greatest_push);
  } else {
    features.snap_in = find_snap_in(approach, threshold);
  }
  analyse_retract(cycle, approach_count, threshold, zero_of_force, features);
  return features;
}

}  // namespace afm::physics
