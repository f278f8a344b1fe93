// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "scene/shared/tip_blocks.h"

namespace afm::servo {
struct RecordedSession;
}

namespace afm::exhibit {

// A jump of a tapping lever from one state to the other.
struct TappedJump {
  double z_m = 0;  // height at which the phase passes that of the free swing
  scene::Swing before{}, after{};
};

// A recorded cycle of a lever in tapping mode, on the way down and up.
struct TappedCycle {
  double free_amplitude_m = 0;
  double drive_hz = 0;
  std::optional<TappedJump> to_repulsion{}, to_attraction{};  // first jump of each kind; empty: none recorded
  double reduction_loop_m2 = 0;  // integral of A0 - A over Z; negative: the push takes energy from the hand
  double mean_force_work_j = 0;  // energy that the mean force, which is not felt, would give to the hand

  double hysteresis_width_m() const;  // difference in height between both jumps; 0 unless both exist
};

// Cycle of a session in tapping mode. A jump's swings are those 5 ms, or eight relaxations, before and after.
TappedCycle tapped_cycle(const servo::RecordedSession& session);

// Members for summary.json, with the names and conventions of `touchafm curve`.
nlohmann::json tapped_json(const TappedCycle& cycle);

// Swing before and after a jump: "A 16.90 → 18.04 nm, φ 122.3° → 64.4°".
std::string jump_text(const TappedJump& jump);

}  // namespace afm::exhibit
