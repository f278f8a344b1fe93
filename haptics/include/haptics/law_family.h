// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/result.h"
#include "physics/law_tables.h"
#include "scene/shared/shared_blocks.h"

namespace afm::haptics {

// The laws between which a map of modulus and adhesion is interpolated (haptics/map_law.h): DMT's, JKR's or Hertz', on
// a grid of columns at equal steps of the share s = E*/(E* + E_k) and rows at equal steps of the work of adhesion, one
// step beyond the map's values on either side. E_k is the modulus whose contact is as stiff as the lever, at a depth of
// a tenth of the tip's radius: s is the share of the lever's stiffness that the hand feels, so that energies are nearly
// linear in it. Everything else is that of the material. Constant; any thread.
class LawFamily {
 public:
  static constexpr double kWidest = 50;  // largest ratio of the moduli of a map

  // `material` and `map` are valid together (scene::validate). Fails with one line if the moduli span more than
  // kWidest, or if the values have no such law. Takes up to half a second, and allocates.
  static core::Result<std::shared_ptr<const LawFamily>> create(const scene::SharedContact& material,
                                                               const scene::SharedLawMap& map);

  std::size_t columns() const noexcept { return columns_; }
  std::size_t rows() const noexcept { return laws_.size() / columns_; }

  // Laws row by row.
  const std::vector<std::shared_ptr<const physics::LawTables>>& laws() const noexcept { return laws_; }

  // Columns and rows of values, and values of columns and rows.
  double column_of(double modulus_pa) const noexcept;
  double row_of(double adhesion_j_per_m2) const noexcept;
  double modulus_pa(double column) const noexcept;
  double adhesion_j_per_m2(double row) const noexcept;

 private:
  LawFamily() = default;

  std::size_t columns_ = 1;
  std::vector<std::shared_ptr<const physics::LawTables>> laws_;
  double share_of(double modulus_pa) const noexcept { return modulus_pa / (modulus_pa + as_lever_pa_); }

  double as_lever_pa_ = 1;                   // E_k, modulus of a contact as stiff as the lever
  double first_share_ = 0, share_step_ = 0;  // share of the first column, and step to the next; 0: a single column
  double first_j_per_m2_ = 0, step_j_per_m2_ = 0;
};

// The contact of a material with another modulus and work of adhesion, and the attraction before contact that belongs
// to that adhesion at the material's atomic distance: A = 12 pi z0^2 W.
physics::ContactParameters contact_with(physics::ContactParameters contact, physics::Pressure reduced_modulus,
                                        double adhesion_j_per_m2);

}  // namespace afm::haptics
