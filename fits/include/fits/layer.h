// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "physics/rows_of_enum.h"

namespace afm::fits {

// Contact between a layer and its rigid base.
enum class Base {
  Bonded,
  Sliding,  // slips without friction
};

struct BaseName {
  Base base;
  std::string_view name;
};
inline constexpr std::array kBases{BaseName{Base::Bonded, "bonded"}, BaseName{Base::Sliding, "sliding"}};
static_assert(physics::has_row_for_each(kBases, &BaseName::base));

enum class Profile {
  Paraboloid,  // strain sqrt(R d)/h
  Cone,        // strain d tan(alpha)/h
};

// Force of a layer over that of a thick sample at the same depth, exact in small strains, by the integral equation of
// Lebedev & Ufliand (1958) and Hayes and others (1972): docs/fits.md (F9). Tabulated once. Const; any thread.
class LayerTable {
 public:
  // Throws std::invalid_argument for a Poisson ratio outside 0 to 0.5.
  LayerTable(Profile profile, Base base, double poisson);

  struct Stiffening {
    double factor = 1;  // factor of the force; 1 for a strain of 0
    double slope = 0;   // derivative of the factor's logarithm by the strain
  };
  // Stiffening at a strain; beyond largest_strain() the logarithm continues along a straight line.
  Stiffening at(double strain) const noexcept;

  double largest_strain() const noexcept { return strains_.back(); }

 private:
  std::vector<double> strains_, logs_, slopes_;  // ascending strains, logarithms of the factor, and their derivatives
};

}  // namespace afm::fits
