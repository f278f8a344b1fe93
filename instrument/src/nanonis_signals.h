// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace afm::instrument {

// Signals of a controller with 128 of them; those without a row are zero. Z is the thirtieth as in Nanonis.
struct Signal {
  std::int32_t index;
  std::string_view name;
  std::string_view channel;  // of the image; empty: none
};
inline constexpr std::int32_t kSignals = 128;
inline constexpr std::array kNamed{Signal{0, "Current (A)", ""},
                                   Signal{1, "Normal force (N)", "Error"},
                                   Signal{2, "Lateral force (N)", "Lateral force"},
                                   Signal{24, "Bias (V)", ""},
                                   Signal{27, "X (m)", ""},
                                   Signal{28, "Y (m)", ""},
                                   Signal{30, "Z (m)", "Height"}};

inline const Signal* find_signal(std::int32_t index) {
  const auto found =
      std::find_if(kNamed.begin(), kNamed.end(), [index](const Signal& signal) { return signal.index == index; });
  return found == kNamed.end() ? nullptr : &*found;
}

inline std::string name_of_signal(std::int32_t index) {
  const Signal* named = find_signal(index);
  return named != nullptr ? std::string(named->name) : fmt::format("Not used {}", index);
}

}  // namespace afm::instrument
