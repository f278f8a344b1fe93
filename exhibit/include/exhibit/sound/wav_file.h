// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace afm::exhibit {

// The bytes of a WAV file of 16-bit samples, left and right in turn, at kSoundRateHz; 1 is full scale.
std::string wav_bytes(std::span<const float> interleaved);

// What a program wrote as WAV: 16 bits, one channel. Programs that write to a pipe do not know its length beforehand:
// the samples reach to the end.
struct MonoWav {
  int rate_hz = 0;
  std::vector<float> samples;
};
std::optional<MonoWav> parse_mono_wav(std::string_view bytes);

// At another rate, by straight lines between the samples: good enough for a voice.
std::vector<float> resampled(const MonoWav& wav, int rate_hz);

}  // namespace afm::exhibit
