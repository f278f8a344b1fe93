// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "core/enumerators.h"

namespace afm::scene {

// Quantity of a whole map that the hand feels as a vibration (haptics/felt_vibration.h).
enum class MapVibration : std::uint32_t { None = 0, Modulus = 1, Adhesion = 2, Loss = 3, Collision = 4 };

struct MapVibrationText {
  MapVibration quantity;
  const char* word;  // value of --map-vibration
  const char* name;  // name in messages
};

inline constexpr std::array kMapVibrations{MapVibrationText{MapVibration::None, "none", "nothing"},
                                           MapVibrationText{MapVibration::Modulus, "modulus", "the modulus"},
                                           MapVibrationText{MapVibration::Adhesion, "adhesion", "the adhesion"},
                                           MapVibrationText{MapVibration::Loss, "loss", "the energy lost in a cycle"},
                                           MapVibrationText{MapVibration::Collision, "collision", "each touch"}};
static_assert(core::has_row_for_each(kMapVibrations, &MapVibrationText::quantity));

constexpr const MapVibrationText& text_of(MapVibration quantity) { return kMapVibrations[core::index_of(quantity)]; }

}  // namespace afm::scene
