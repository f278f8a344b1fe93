// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "physics/units.h"

namespace afm::physics {

class TapSurface;
struct DrivenLever;
struct LawTables;

// Amplitude of the last row in the tables of the averages, as a share of the free amplitude.
inline constexpr double kLargestAveragedShare = 1.25;
// Amplitude beyond which a hand has no force until it is lifted, as a share of the free amplitude.
inline constexpr double kLostSwingShare = 2.0;

// Largest amplitude at which the push of a hand is that of the swing.
Length largest_felt_swing(const DrivenLever& lever) noexcept;

// Largest amplitude of a slow hand on its way down and up, at least: a stiff sample raises the resonance of the lever,
// and enlarges the swing of a drive above it. `tables` are tapped_law_tables() of this surface and lever. For a drive
// at or below the resonance the free amplitude, at once; else takes tenths of a second, and allocates.
Length largest_swing_of_hand(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever,
                             const LawTables& tables);

}  // namespace afm::physics
