// SPDX-License-Identifier: Apache-2.0
#include "haptics/law_family.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>

#include "physics/quantity_text.h"
#include "scene/shared/shared_segment.h"

namespace afm::haptics {

namespace {

constexpr double kSame = 1e-6;             // relative range below which all values count as one
constexpr std::size_t kModulusSteps = 12;  // number of steps between the softest and the stiffest modulus
constexpr std::size_t kAdhesionSteps = 3;  // number of steps between the weakest and the strongest adhesion
constexpr double kLeastShare = 0.1;        // smallest modulus of a law, as a share of the map's smallest
constexpr double kWeakest = 1e-3;          // smallest adhesion of a law, as a share of the largest

struct Values {
  double low, high;
};

Values values_of(std::span<const float> values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {static_cast<double>(*low), static_cast<double>(*high)};
}

std::string text_of(double ln_modulus) {
  constexpr int kDigits = 3;
  return physics::format_quantity(physics::Pressure(std::exp(ln_modulus)), physics::kPressureUnits, kDigits);
}

}  // namespace

physics::ContactParameters contact_with(physics::ContactParameters contact, physics::Pressure reduced_modulus,
                                        double adhesion_j_per_m2) {
  constexpr physics::ContactField kHamaker = physics::contact_field("hamaker");
  const double hamaker_j =
      12.0 * std::numbers::pi * contact.atomic_distance.si * contact.atomic_distance.si * adhesion_j_per_m2;
  contact.hamaker = physics::Energy(std::clamp(hamaker_j, kHamaker.smallest, kHamaker.largest));
  contact.mean_surface_energy = physics::SurfaceEnergy(0.5 * adhesion_j_per_m2);
  contact.reduced_modulus = reduced_modulus;
  return contact;
}

core::Result<std::shared_ptr<const LawFamily>> LawFamily::create(const scene::SharedContact& material,
                                                                 const scene::SharedLawMap& map) {
  const std::size_t count = std::size_t{map.columns} * map.rows;
  const Values modulus = values_of(std::span(map.ln_modulus).first(count));
  const Values adhesion = values_of(std::span(map.adhesion_j_per_m2).first(count));
  const double range = modulus.high - modulus.low;
  if (range > std::log(kWidest)) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("the moduli of the map span a factor of {:.0f}, from {} to {}; a hand can feel a "
                                     "factor of {:.0f} on one scale",
                                     std::exp(range), text_of(modulus.low), text_of(modulus.high), kWidest));
  }
  std::shared_ptr<LawFamily> family(new LawFamily);
  const double softest_pa = std::exp(modulus.low), stiffest_pa = std::exp(modulus.high);
  constexpr double kDepth = 0.1;  // depth of indentation in tip radii
  family->as_lever_pa_ =
      material.contact.spring_constant.si / (2.0 * std::sqrt(kDepth) * material.contact.tip_radius.si);
  family->first_share_ = family->share_of(softest_pa);
  if (range > kSame) {
    family->share_step_ =
        (family->share_of(stiffest_pa) - family->share_of(softest_pa)) / static_cast<double>(kModulusSteps);
    family->first_share_ -= family->share_step_;
    family->columns_ = kModulusSteps + 3;
  }
  std::size_t rows = 1;
  family->first_j_per_m2_ = adhesion.low;
  if (adhesion.high - adhesion.low > kSame * adhesion.high) {
    family->step_j_per_m2_ = (adhesion.high - adhesion.low) / static_cast<double>(kAdhesionSteps);
    family->first_j_per_m2_ -= family->step_j_per_m2_;
    rows = kAdhesionSteps + 3;
  }
  try {
    for (std::size_t row = 0; row < rows; ++row) {
      // the law before the weakest adhesion or the softest modulus may lie below zero
      const double adhesion_j = std::max(family->adhesion_j_per_m2(static_cast<double>(row)), kWeakest * adhesion.high);
      for (std::size_t column = 0; column < family->columns_; ++column) {
        const double modulus_pa = std::max(family->modulus_pa(static_cast<double>(column)), kLeastShare * softest_pa);
        family->laws_.push_back(physics::build_law_tables(
            material.law, contact_with(material.contact, physics::Pressure(modulus_pa), adhesion_j),
            scene::law_options(material)));
      }
    }
  } catch (const std::invalid_argument& error) {
    return core::failure(core::ErrorCategory::Failed, error.what());
  }
  return family;
}

double LawFamily::column_of(double modulus_pa) const noexcept {
  return share_step_ > 0.0 ? (share_of(modulus_pa) - first_share_) / share_step_ : 0.0;
}

double LawFamily::row_of(double adhesion_j_per_m2) const noexcept {
  return step_j_per_m2_ > 0.0 ? (adhesion_j_per_m2 - first_j_per_m2_) / step_j_per_m2_ : 0.0;
}

double LawFamily::modulus_pa(double column) const noexcept {
  // beyond the stiffest the share may reach that of a rigid sample
  const double share = std::fmin(first_share_ + column * share_step_, 1.0 - 1e-3);
  return as_lever_pa_ * share / (1.0 - share);
}

double LawFamily::adhesion_j_per_m2(double row) const noexcept { return first_j_per_m2_ + row * step_j_per_m2_; }

}  // namespace afm::haptics
