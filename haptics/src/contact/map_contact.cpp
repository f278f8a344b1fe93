// SPDX-License-Identifier: Apache-2.0
#include "haptics/map_contact.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>
#include <utility>

#include "contact/felt_vibration.h"
#include "core/enumerators.h"
#include "haptics/hand_motion.h"

namespace afm::haptics {

using physics::Phase;
using scene::ScaleMode;

namespace {

constexpr double kLeastLengthM = 1e-12;     // length of a coordinate's height for a map with one law
constexpr double kWidestBend_per_m = 1e15;  // curvature that is no limit
constexpr double kNoJumpM = 1e-6;           // width of a loop on the hand below which there is no jump
constexpr double kMostOfStiffness = 1.001;  // largest stiffness along the normal as a multiple of the device's
constexpr double kLongestFloorM = 1.0;      // length beyond any reach, for a map without a floor
constexpr double kDampedMPerS = 1.0;        // speed at which the damping is no stronger than the device's force
constexpr double kFirstShare = 1e-6;        // share of the damping that begins without delay
constexpr double kFeltCollisions = 5.0;     // duration of a touch's vibration in units of its time constant

// Heights of the hand in the workspace, for a level sample.
PotentialEnergy::Range within(const DeviceSpec& device) {
  return {device.workspace_min_m.y - device.contact_point_m.y, device.workspace_max_m.y - device.contact_point_m.y};
}

// Step from 0 at 0 to 1 at 1, level at both ends and beyond.
double eased(double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// Share of the floor in the force at a height of the hand, from the height where it begins.
double floor_share(double height_m, double begins_m, double floor_m) { return eased((begins_m - height_m) / floor_m); }

// The family on the hand, at every height that the hand can reach, for any orientation of the sample.
std::shared_ptr<const MapLaw> on_hand(const LawFamily& family, const Scaling& scaling, const DeviceSpec& device,
                                      double floor_m) {
  const auto force_n = [&scaling](const physics::BranchTable& branch, double height_m) {
    return scaling.hand_force_n(branch.force(physics::Length(scaling.z_m(height_m))).si);
  };
  const double begins_m = scaling.hand_height_m(0.0) - Scaling::kPushM;
  const auto hardest_n = [&](double height_m) {
    double most_n = force_n(family.laws().front()->attached, height_m);
    for (const auto& tables : family.laws()) most_n = std::max(most_n, force_n(tables->attached, height_m));
    return most_n;
  };
  std::vector<MapLaw::Law> laws;
  laws.reserve(family.laws().size());
  // tabulated once: every law looks it up
  const double reach_m = glm::length(glm::max(glm::abs(device.workspace_min_m - device.contact_point_m),
                                              glm::abs(device.workspace_max_m - device.contact_point_m)));
  const HeightPotential floor(hardest_n, {-reach_m, std::max(begins_m, HeightPotential::kSpacingM - reach_m)});
  for (const auto& tables : family.laws()) {
    const auto attached_n = [&, law = tables.get()](double height_m) {
      const double own_n = force_n(law->attached, height_m), share = floor_share(height_m, begins_m, floor_m);
      return share > 0.0 ? own_n + share * (floor.at(height_m).force_n - own_n) : own_n;
    };
    laws.push_back({[&, law = tables.get()](double height_m) { return force_n(law->free, height_m); }, attached_n,
                    scaling.hand_height_m(tables->figures.z_jtc.si), scaling.hand_height_m(tables->figures.z_joc.si)});
  }
  return std::make_shared<const MapLaw>(laws, family.columns(), PotentialEnergy::Range{-reach_m, reach_m});
}

// Scale of a coordinate as a surface over the sample, and the surface.
struct Sheet {
  const scene::SharedLawMap& map;
  double spacing_m;
  double lateral_m_per_m;
  const DeviceSpec& device;

  // Lays a coordinate over the sample, as smooth as the limits of MapContact need for such laws.
  template <class Laid, class Coordinate>
  Laid lay(std::span<const float> values, const MapLaw::Change& most, const Coordinate& coordinate) const {
    std::vector<float> coordinates;
    for (const float value : values.first(std::size_t{map.columns} * map.rows)) {
      coordinates.push_back(static_cast<float>(coordinate(static_cast<double>(value))));
    }
    const double share_n_per_m =
        MapContact::kShareOfStiffness * std::min(Scaling::kMaxStiffnessNPerM, device.max_stiffness_n_per_m);
    const double slope = SampleSurface::kSteepestSlope / lateral_m_per_m;
    Laid laid;
    laid.length_m =
        std::max({kLeastLengthM, slope * most.energy_j / (MapContact::kShareSideways * force_cap_n(device)),
                  slope * most.force_n / share_n_per_m, slope * std::sqrt(most.second_energy_j / share_n_per_m)});
    const double square = lateral_m_per_m * lateral_m_per_m;
    scene::FeltHeights heights;
    heights.columns = map.columns;
    heights.rows = map.rows;
    heights.spacing_m = spacing_m;
    heights.height_factor = laid.length_m;
    heights.height_m = coordinates;
    heights.heights = scene::Heights::Scaled;
    laid.surface = SampleSurface(
        heights, 0.0, most.energy_j > 0.0 ? share_n_per_m * laid.length_m * square / most.energy_j : kWidestBend_per_m);
    laid.steepest_per_m = laid.surface.steepest_slope() / (laid.length_m * lateral_m_per_m);
    laid.bend_per_m2 = laid.surface.largest_curvature_per_m() / (laid.length_m * square);
    return laid;
  }
};

}  // namespace

MapContact::MapContact(std::shared_ptr<const LawFamily> family, std::shared_ptr<const physics::LawTables> nominal,
                       const scene::SharedLawMap& map, double spacing_m, const Scalings& scalings,
                       const DeviceSpec& device, const Channels& channels)
    : family_(std::move(family)),
      nominal_(std::move(nominal)),
      most_damping_n_s_per_m_(channels.damps ? std::min(kMostDampingNSPerM, force_cap_n(device) / kDampedMPerS) : 0.0),
      vibrates_by_(channels.vibration),
      ln_modulus_(spread_of(map, map.ln_modulus)),
      adhesion_j_per_m2_(spread_of(map, map.adhesion_j_per_m2)),
      vibration_(std::make_unique<FeltVibration>(device)) {
  const double stands_n_per_m = std::min(Scaling::kMaxStiffnessNPerM, device.max_stiffness_n_per_m);
  for (const scene::ScaleModeText& row : scene::kScalesOfSamples) {
    const Scaling& scaling = scalings[core::index_of(row.mode)];
    OnScale& scale = scales_[core::index_of(row.mode)];
    if (row.mode == ScaleMode::Atoms) {
      scale = on(ScaleMode::Fit);  // scale of Fit, which comes first; the laws are the same along the normal
    } else {
      // a longer way to the floor is softer
      double floor_m = kFloorM;
      do {
        scale.law = on_hand(*family_, scaling, device, floor_m);
        scale.steepness = scale.law->steepness(within(device));
        floor_m *= 2.0;
      } while (scale.steepness.stiffness_n_per_m > kMostOfStiffness * stands_n_per_m && floor_m < kLongestFloorM);
      scale.least_j = scale.law->least_j(within(device));
      scale.most_loss_j = most_loss_j(*scale.law, map);
    }
    const Sheet sheet{map, spacing_m, scaling.lateral_m_per_m(), device};
    const MapLaw::Steepness& most = scale.steepness;
    scale.columns = sheet.lay<Laid>(std::span<const float>(map.ln_modulus), most.by_column,
                                    [this](double value) { return family_->column_of(std::exp(value)); });
    scale.rows = sheet.lay<Laid>(std::span<const float>(map.adhesion_j_per_m2), most.by_row,
                                 [this](double value) { return family_->row_of(value); });
    const double twist_j = std::max(most.by_column.second_energy_j, most.by_row.second_energy_j);
    const double steepest_per_m = scale.columns.steepest_per_m + scale.rows.steepest_per_m;
    const double sideways_n_per_m = most.by_column.energy_j * scale.columns.bend_per_m2 +
                                    most.by_row.energy_j * scale.rows.bend_per_m2 +
                                    twist_j * steepest_per_m * steepest_per_m;
    // of a matrix: no more than the larger of both directions and what couples them
    scale.stiffness_n_per_m = std::max(most.stiffness_n_per_m, sideways_n_per_m) +
                              most.by_column.force_n * scale.columns.steepest_per_m +
                              most.by_row.force_n * scale.rows.steepest_per_m;
  }
  // without particles there is no other scale for them
  scales_[core::index_of(ScaleMode::Particles)] = on(ScaleMode::Fit);
}

// Largest loss of a cycle at any point of the map.
double MapContact::most_loss_j(const MapLaw& law, const scene::SharedLawMap& map) const {
  double most_j = 0.0;
  for (std::size_t cell = 0; cell < std::size_t{map.columns} * map.rows; ++cell) {
    const double modulus_pa = std::exp(static_cast<double>(map.ln_modulus[cell]));
    const double row = family_->row_of(static_cast<double>(map.adhesion_j_per_m2[cell]));
    most_j = std::max(most_j, law.loss_j({.at = {family_->column_of(modulus_pa), row}}));
  }
  return most_j;
}

MapContact::~MapContact() = default;

glm::dvec3 MapContact::vibrate(const glm::dvec3& hand_m, double room_n, double elapsed_s) noexcept {
  return vibration_->step(hand_m, vibrates_, room_n, elapsed_s);
}

MapContact::Spread MapContact::spread_of(const scene::SharedLawMap& map, std::span<const float> values) {
  const auto [least, most] = std::ranges::minmax(values.first(std::size_t{map.columns} * map.rows));
  return {static_cast<double>(least), static_cast<double>(most)};
}

double MapContact::Spread::share_of(double value) const noexcept {
  return most > least ? std::clamp((value - least) / (most - least), 0.0, 1.0) : 0.0;
}

MapLaw::Place MapContact::place_at(const OnScale& scale, const glm::dvec2& xy_m, double lateral_m_per_m) noexcept {
  const SampleSurface::Place column = scale.columns.surface.at(xy_m), row = scale.rows.surface.at(xy_m);
  return {.at = {column.height_m / scale.columns.length_m, row.height_m / scale.rows.length_m},
          .column_slope = column.slope / (scale.columns.length_m * lateral_m_per_m),
          .row_slope = row.slope / (scale.rows.length_m * lateral_m_per_m)};
}

physics::Force MapContact::tip_force(Phase phase, const MapLaw::Mixture& mixture, double z_m) const noexcept {
  double sum_n = 0.0;
  for (std::size_t k = 0; k < MapLaw::kMixed; ++k) {
    const physics::LawTables& law = *family_->laws()[mixture.law[k]];
    const physics::BranchTable& branch = phase == Phase::Attached ? law.attached : law.free;
    sum_n += mixture.weight[k] * branch.force(physics::Length(z_m)).si;
  }
  return physics::Force(sum_n);
}

// Adds the jump between the previous step and this one, if there was one.
void MapContact::note_jump(const MapLaw& law, const Scaling& scale, const MapLaw::Place& place, double hand_m,
                           Phase before, MapTouch& touch) const noexcept {
  const double in_m = law.jump_in_m(place), off_m = law.jump_off_m(place);
  if (before == phase_ || before == Phase::WaitForLift || off_m - in_m < kNoJumpM) return;
  const bool in = phase_ == Phase::Attached;
  const double jump_m = in ? in_m : off_m;
  const double was_m = in ? above_in_m_ : above_off_m_, is_m = hand_m - jump_m;
  const MapLaw::Mixture mixture = law.mixture_of(place);
  const double z_m = scale.z_m(jump_m);
  touch.response.add({.kind = in ? physics::EventKind::JumpToContact : physics::EventKind::JumpOffContact,
                      .z = physics::Length(z_m),
                      .force_before = tip_force(before, mixture, z_m),
                      .force_after = tip_force(phase_, mixture, z_m),
                      .fraction = was_m != is_m ? std::clamp(was_m / (was_m - is_m), 0.0, 1.0) : 1.0});
}

// Damping on the hand, none while the tip waits for a lift.
double MapContact::damp(const MapLaw& law, const MapLaw::Place& place, double hand_m, double elapsed_s) noexcept {
  if (most_damping_n_s_per_m_ == 0.0 || phase_ == Phase::WaitForLift) return damping_n_s_per_m_ = 0.0;
  const double share = law.most_loss_j() > 0.0 ? law.loss_j(place) / law.most_loss_j() : 0.0;
  const double near = 1.0 - eased((hand_m - law.jump_off_m(place)) / kDampsAboveM);
  const double wanted = most_damping_n_s_per_m_ * near * (kLeastOfDamping + (1.0 - kLeastOfDamping) * share);
  const double grown = std::max(damping_n_s_per_m_, kFirstShare * most_damping_n_s_per_m_) *
                       std::exp(2.0 * std::numbers::pi * HandMotion::kCutoffHz * elapsed_s);
  return damping_n_s_per_m_ = std::min(wanted, grown);
}

// Strength from 0 to 1, none while the tip waits for a lift.
double MapContact::strength_of_vibration(const OnScale& scale, const MapLaw::Place& place, double hand_m, Phase before,
                                         double elapsed_s) noexcept {
  const MapLaw& law = *scale.law;
  const double most_loss_j = scale.most_loss_j;
  using scene::MapVibration;
  const bool touches = before == Phase::Free && phase_ == Phase::Attached;
  touched_s_ = touches ? 0.0 : touched_s_ + elapsed_s;
  if (vibrates_by_ == MapVibration::None || phase_ == Phase::WaitForLift) return 0.0;
  const double near = 1.0 - eased((hand_m - law.jump_off_m(place)) / kVibratesAboveM);
  switch (vibrates_by_) {
    case MapVibration::None:
      break;
    case MapVibration::Modulus:
      return near * ln_modulus_.share_of(std::log(family_->modulus_pa(place.at.x)));
    case MapVibration::Adhesion:
      return near * adhesion_j_per_m2_.share_of(family_->adhesion_j_per_m2(place.at.y));
    case MapVibration::Loss:
      return most_loss_j > 0.0 ? near * std::min(1.0, law.loss_j(place) / most_loss_j) : 0.0;
    case MapVibration::Collision:
      return touched_s_ < kFeltCollisions * kCollisionS ? std::exp(-touched_s_ / kCollisionS) : 0.0;
  }
  return 0.0;
}

void MapContact::wait_for_lift() noexcept {
  phase_ = Phase::WaitForLift;
  vibrates_ = 0.0;
  touched_s_ = kFeltCollisions * kCollisionS;
  vibration_->rest();
}

MapTouch MapContact::step(ScaleMode mode, const Scaling& scale, const glm::dvec2& xy_m, double z_m,
                          double elapsed_s) noexcept {
  MapTouch touch;
  if (!std::isfinite(z_m) || !std::isfinite(xy_m.x) || !std::isfinite(xy_m.y)) {
    wait_for_lift();
    return touch;
  }
  const OnScale& on_scale = on(mode);
  const MapLaw& law = *on_scale.law;
  const MapLaw::Place place = place_at(on_scale, xy_m, scale.lateral_m_per_m());
  const double hand_m = scale.hand_height_m(z_m);
  const Phase before = std::exchange(phase_, law.next_phase(phase_, place, hand_m));
  const physics::Force force =
      phase_ == Phase::WaitForLift ? physics::Force() : tip_force(phase_, law.mixture_of(place), z_m);
  touch.response = physics::respond(*nominal_, phase_, physics::Length(z_m), force);
  note_jump(law, scale, place, hand_m, before, touch);
  above_in_m_ = hand_m - law.jump_in_m(place);
  above_off_m_ = hand_m - law.jump_off_m(place);
  const MapLaw::Felt felt = law.at(phase_, place, hand_m);
  touch.force_n = felt.force_n;
  touch.sideways_n = felt.sideways_n;
  if (phase_ != Phase::WaitForLift) touch.stored_j = felt.energy_j - on_scale.least_j;
  touch.damping_n_s_per_m = damp(law, place, hand_m, elapsed_s);
  vibrates_ = strength_of_vibration(on_scale, place, hand_m, before, elapsed_s);
  touch.here = {.reduced_modulus_pa = family_->modulus_pa(place.at.x),
                .adhesion_j_per_m2 = family_->adhesion_j_per_m2(place.at.y)};
  return touch;
}

double MapContact::attached_j(ScaleMode mode, const Scaling& scale, const glm::dvec2& xy_m, double z_m) const noexcept {
  const OnScale& on_scale = on(mode);
  const MapLaw::Place place = place_at(on_scale, xy_m, scale.lateral_m_per_m());
  return on_scale.law->at(Phase::Attached, place, scale.hand_height_m(z_m)).energy_j - on_scale.least_j;
}

}  // namespace afm::haptics
