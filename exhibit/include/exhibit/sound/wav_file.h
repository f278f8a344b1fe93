// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace afm::exhibit {

// Contents of a WAV file with 16-bit samples, left and right alternating, at kSoundRateHz; 1 is full scale.
std::string wav_bytes(std::span<const float> interleaved);

// A program's WAV output: 16 bits, one channel. A program that writes to a pipe does not know the length in advance, so
// the samples extend to the end.
struct MonoWav {
  int rate_hz = 0;
  std::vector<float> samples;
};
std::optional<MonoWav> parse_mono_wav(std::string_view bytes);

// Voice resampled by linear interpolation, which is accurate enough for speech.
std::vector<float> resampled(const MonoWav& wav, int rate_hz);

}  // namespace afm::exhibit
