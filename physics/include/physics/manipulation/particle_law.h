// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "physics/rows_of_enum.h"

namespace afm::physics {

// The laws disagree by a factor of 2 to 20 for particles below 100 nm, so every user chooses one by name.
enum class ParticleLaw : std::uint32_t {
  ContactArea = 0,  // tau pi a(P)^2
  Amontons = 1,     // mu (P + F_ad)
  Both = 2,         // mu P + tau pi a(P)^2
  Measured = 3,     // a threshold that was measured, at any load
};

struct ParticleLawText {
  ParticleLaw law;
  std::string_view word;     // in particle files
  std::string_view formula;  // text for people
};

inline constexpr std::array kParticleLaws{
    ParticleLawText{ParticleLaw::ContactArea, "area", "shear strength x contact area"},
    ParticleLawText{ParticleLaw::Amontons, "amontons", "coefficient x (load + adhesion)"},
    ParticleLawText{ParticleLaw::Both, "both", "coefficient x load + shear strength x contact area"},
    ParticleLawText{ParticleLaw::Measured, "measured", "measured threshold"}};
static_assert(has_row_for_each(kParticleLaws, &ParticleLawText::law));

constexpr const ParticleLawText& text_of(ParticleLaw law) { return kParticleLaws.at(static_cast<std::size_t>(law)); }

}  // namespace afm::physics
