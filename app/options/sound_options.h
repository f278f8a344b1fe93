// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "app/options/command_line.h"

namespace afm::exhibit {
enum class Channels;
}

namespace afm::app {

struct SoundOptions {
  double volume_db = -6;
  bool mono = false;

  exhibit::Channels channels() const;
  double gain() const;  // linear amplitude of the volume
};

inline constexpr double kQuietestDb = -60, kLoudestDb = 0;

// Volume from a number with its unit, "-12dB" or "-12 dB"; empty for any other text.
std::optional<double> parse_decibels(std::string_view text);

// Adds --volume and --mono-sound.
void add_sound_options(OptionList& command, SoundOptions& options);

}  // namespace afm::app
