// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string_view>

#include "curves/tapping/tapping_sweep.h"

namespace afm::curves {

inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

struct RegimeRow {
  std::string_view word, meaning;
};
inline constexpr std::array kRegimesAtHeight{RegimeRow{"attractive", "only an attractive or the free swing is stable"},
                                             RegimeRow{"repulsive", "only a repulsive swing is stable"},
                                             RegimeRow{"both", "both are stable, and the past decides"}};
inline constexpr std::array kRegimesOfCurve{
    RegimeRow{"attractive", "the swing stays attractive all the way; islands may exist that the path does not reach"},
    RegimeRow{"repulsive", "the swing is never clearly attractive"},
    RegimeRow{"smooth", "the swing passes from attractive to repulsive without a jump"},
    RegimeRow{"hysteresis", "the swing jumps between its states"}};

inline constexpr std::array<std::string_view, 6> kColumnsAtHeight{"attractive_amplitude_m",  "attractive_phase_deg",
                                                                  "attractive_peak_force_N", "repulsive_amplitude_m",
                                                                  "repulsive_phase_deg",     "repulsive_peak_force_N"};
inline constexpr std::array<std::string_view, 12> kColumnsOfCurve{"jump_in_z_m",
                                                                  "amplitude_before_jump_in_m",
                                                                  "phase_before_jump_in_deg",
                                                                  "amplitude_after_jump_in_m",
                                                                  "phase_after_jump_in_deg",
                                                                  "jump_off_z_m",
                                                                  "amplitude_before_jump_off_m",
                                                                  "phase_before_jump_off_deg",
                                                                  "amplitude_after_jump_off_m",
                                                                  "phase_after_jump_off_deg",
                                                                  "hysteresis_width_m",
                                                                  "islands"};

inline std::span<const RegimeRow> regimes_of(const TappingSweep& sweep) {
  return sweep.at_heights ? std::span<const RegimeRow>(kRegimesAtHeight) : kRegimesOfCurve;
}
inline std::span<const std::string_view> columns_of(const TappingSweep& sweep) {
  return sweep.at_heights ? std::span<const std::string_view>(kColumnsAtHeight) : kColumnsOfCurve;
}

}  // namespace afm::curves
