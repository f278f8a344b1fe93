// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "nanonis_bytes.h"
#include "refused_request.h"

namespace afm::instrument {

// Signals of a controller with 128 of them; those without a row are zero. Z is the thirtieth as in Nanonis.
struct Signal {
  std::int32_t index;
  std::string_view name;
  std::string_view channel;  // channel of the image with this signal; empty: none
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

// Index of a signal. RefusedRequest for any other number.
inline std::int32_t index_of(NanonisReader& in) {
  const auto index = in.read<std::int32_t>();
  if (index < 0 || index >= kSignals) throw RefusedRequest(fmt::format("there is no signal {}", index));
  return index;
}

// A count of 1 to kSignals, and as many indexes of signals. RefusedRequest for any other count or index.
inline std::vector<std::int32_t> indexes_of(NanonisReader& in) {
  const auto count = in.read<std::int32_t>();
  if (count < 1 || count > kSignals)
    throw RefusedRequest(fmt::format("{} signals instead of 1 to {}", count, kSignals));
  std::vector<std::int32_t> indexes(static_cast<std::size_t>(count));
  for (std::int32_t& index : indexes) index = index_of(in);
  return indexes;
}

}  // namespace afm::instrument
