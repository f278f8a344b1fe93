// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "physics/rows_of_enum.h"

namespace afm::physics {

inline constexpr std::size_t kMostParticles = 2048;
inline constexpr std::size_t kMostStickyPads = 8;

enum class PushState : std::uint32_t {
  Free = 0,   // no sphere is touched
  Holds = 1,  // a sphere is touched, and stays
  Slides = 2,
  Rolls = 3,
  Several = 4,  // more than one sphere moves or could move
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

}  // namespace afm::physics
