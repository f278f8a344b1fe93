// SPDX-License-Identifier: Apache-2.0
#include "app/options/sound_options.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

#include "exhibit/sound/synthesizer.h"

namespace afm::app {

exhibit::Channels SoundOptions::channels() const { return mono ? exhibit::Channels::Mono : exhibit::Channels::Stereo; }

double SoundOptions::gain() const { return std::pow(10.0, volume_db / 20.0); }

std::optional<double> parse_decibels(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  std::string_view unit = text.substr(static_cast<std::size_t>(end - text.data()));
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  if (error != std::errc() || unit != "dB" || !std::isfinite(value)) return std::nullopt;
  return value;
}

void add_sound_options(OptionList& command, SoundOptions& options) {
  const auto read = [&options](const std::string& text) -> core::Result<void> {
    const auto value = parse_decibels(text);
    if (!value || *value < kQuietestDb || *value > kLoudestDb) {
      return core::failure(core::ErrorCategory::WrongUsage,
                           fmt::format("\"{}\" is not a level of {:g}dB to {:g}dB with its unit, such as -12dB", text,
                                       kQuietestDb, kLoudestDb));
    }
    options.volume_db = *value;
    return {};
  };
  command
      .add_parsed_option(
          "--volume", read,
          fmt::format("volume of sound and speech, {:g}dB (faint) to {:g}dB (loudest)", kQuietestDb, kLoudestDb))
      .show_default(fmt::format("{:g}dB", options.volume_db))
      .type_name("LEVEL");
  command.add_flag("--mono-sound", options.mono,
                   "the same on both sides; pull and push then differ by the sharper tone of the push");
}

}  // namespace afm::app
