// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "physics/rows_of_enum.h"

// Words for particles that a tip pushes: their laws of friction, and the states of a push.
namespace afm::physics {

inline constexpr std::size_t kMostParticles = 2048;
inline constexpr std::size_t kMostStickyPads = 8;

enum class PushState : std::uint32_t {
  Free = 0,   // no particle is touched
  Holds = 1,  // a particle is touched and stays in place
  Slides = 2,
  Rolls = 3,
  Several = 4,  // more than one particle moves or could move
  Carried = 5,  // a sphere hangs on the tip, off the sample
};

struct PushStateText {
  PushState state;
  std::string_view word;
};
inline constexpr std::array kPushStates{
    PushStateText{PushState::Free, "free"},       PushStateText{PushState::Holds, "holds"},
    PushStateText{PushState::Slides, "slides"},   PushStateText{PushState::Rolls, "rolls"},
    PushStateText{PushState::Several, "several"}, PushStateText{PushState::Carried, "carried"}};
static_assert(has_row_for_each(kPushStates, &PushStateText::state));

// The laws disagree by a factor of 2 to 20 for particles below 100 nm, so every user chooses one by name.
enum class ParticleLaw : std::uint32_t {
  ContactArea = 0,  // shear strength times contact area, tau pi a(P)^2
  Amontons = 1,     // coefficient times load and adhesion, mu (P + F_ad)
  Both = 2,         // sum of a load term and an area term, mu P + tau pi a(P)^2
  Measured = 3,     // measured threshold, independent of the load
};

struct ParticleLawText {
  ParticleLaw law;
  std::string_view word;     // spelling in particle files
  std::string_view formula;  // formula in words, for people
};

inline constexpr std::array kParticleLaws{
    ParticleLawText{ParticleLaw::ContactArea, "area", "shear strength x contact area"},
    ParticleLawText{ParticleLaw::Amontons, "amontons", "coefficient x (load + adhesion)"},
    ParticleLawText{ParticleLaw::Both, "both", "coefficient x load + shear strength x contact area"},
    ParticleLawText{ParticleLaw::Measured, "measured", "measured threshold"}};
static_assert(has_row_for_each(kParticleLaws, &ParticleLawText::law));

constexpr const ParticleLawText& text_of(ParticleLaw law) { return kParticleLaws.at(static_cast<std::size_t>(law)); }

}  // namespace afm::physics
