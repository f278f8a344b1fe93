// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "physics/quantity_text.h"
#include "physics/units.h"

namespace afm::physics {

// Parameters of a force law for a combination of tip, lever, sample and medium. The paper's law (Liu & Peng, Table 1)
// uses only the first five.
struct ContactParameters {
  Length tip_radius;                  // R, radius of the tip
  Stiffness spring_constant;          // k_c, spring constant of the cantilever
  Stiffness sample_stiffness;         // k_s, stiffness of an elastic support below the contact; infinite: rigid
  Energy hamaker;                     // A_H, Hamaker constant of tip and sample across the medium
  SurfaceEnergy mean_surface_energy;  // sqrt(gamma_s gamma_t), half of the work of adhesion (3.3)
  Pressure reduced_modulus{std::numeric_limits<double>::infinity()};  // E*, 1/E* = (1-nu_t^2)/E_t + (1-nu_s^2)/E_s
  Length atomic_distance{0.3e-9};                                     // z0 of the surface Lennard-Jones potential
};

// A value outside the range of any force microscope. The message quotes it with its unit and the legal range.
class UnphysicalValue : public std::invalid_argument {
 public:
  UnphysicalValue(std::string field_name, const std::string& message)
      : std::invalid_argument(message), field_(std::move(field_name)) {}

  // Name of the member of ContactParameters: "tip_radius".
  const std::string& field() const noexcept { return field_; }

 private:
  std::string field_;
};

// Description of one member of ContactParameters for files, checks and messages.
struct ContactField {
  std::string_view name;      // name of the member; messages print it with spaces for underscores
  std::string_view json_key;  // key of its SI value in session files and in headers of recorded curves
  std::string_view meaning;   // symbol of the quantity, for help texts
  double smallest;            // smallest legal value, SI
  double largest;             // largest legal value, SI
  Infinity infinity;          // Allowed: infinity is legal and means a rigid body
  const Units* units;
  double (*get)(const ContactParameters& contact);  // getter of the SI value
  void (*set)(ContactParameters& contact, double si);

  // The legal range as text: "100 pm to 1 mm".
  std::string range() const { return range_text(smallest, largest, *units); }
};

template <auto Member>
constexpr ContactField contact_field(std::string_view name, std::string_view json_key, std::string_view meaning,
                                     double smallest, double largest, const Units& units,
                                     Infinity infinity = Infinity::Refused) {
  return {name,
          json_key,
          meaning,
          smallest,
          largest,
          infinity,
          &units,
          [](const ContactParameters& contact) { return (contact.*Member).si; },
          [](ContactParameters& contact, double si) { (contact.*Member).si = si; }};
}

// Rows in the order of the members. The ranges are those of real force microscopes with a margin.
inline constexpr std::array kContactFields{
    contact_field<&ContactParameters::tip_radius>("tip_radius", "tip_radius_m", "R", 1e-10, 1e-3, kLengthUnits),
    contact_field<&ContactParameters::spring_constant>("spring_constant", "spring_constant_N_per_m", "k_c", 1e-6, 1e6,
                                                       kStiffnessUnits),
    contact_field<&ContactParameters::sample_stiffness>(
        "sample_stiffness", "sample_stiffness_N_per_m", "k_s of an elastic support", 1e-6,
        std::numeric_limits<double>::infinity(), kStiffnessUnits, Infinity::Allowed),
    contact_field<&ContactParameters::hamaker>("hamaker", "hamaker_J", "A_H", 1e-24, 1e-16, kEnergyUnits),
    contact_field<&ContactParameters::mean_surface_energy>("mean_surface_energy", "mean_surface_energy_J_per_m2",
                                                           "sqrt(gamma_s gamma_t)", 1e-9, 100.0, kSurfaceEnergyUnits),
    contact_field<&ContactParameters::reduced_modulus>("reduced_modulus", "reduced_modulus_Pa", "E*", 1.0, 1e13,
                                                       kPressureUnits, Infinity::Allowed),
    contact_field<&ContactParameters::atomic_distance>("atomic_distance", "atomic_distance_m", "z0", 0.05e-9, 5e-9,
                                                       kLengthUnits),
};
static_assert(sizeof(ContactParameters) == kContactFields.size() * sizeof(double),
              "every member of ContactParameters needs one row in kContactFields");

// The row of that name. An unknown name does not compile.
consteval const ContactField& contact_field(std::string_view name) {
  std::size_t i = 0;
  while (kContactFields.at(i).name != name) ++i;
  return kContactFields.at(i);
}

// Throws UnphysicalValue unless every value is within the range of its row, or infinite if that is allowed.
void validate(const ContactParameters& contact);

}  // namespace afm::physics
