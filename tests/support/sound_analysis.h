// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstring>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

// Analysis of a sound: pitch, level and steps.
namespace afm::test {

// Left (0) or right (1) channel of alternating samples.
inline std::vector<double> channel(std::span<const float> interleaved, std::size_t which) {
  std::vector<double> samples;
  for (std::size_t i = which; i < interleaved.size(); i += 2) samples.push_back(static_cast<double>(interleaved[i]));
  return samples;
}

inline std::vector<std::complex<double>> fft(std::vector<std::complex<double>> x) {
  const std::size_t n = x.size();  // must be a power of two
  if (n == 1) return x;
  std::vector<std::complex<double>> even, odd;
  for (std::size_t i = 0; i < n; i += 2) {
    even.push_back(x[i]);
    odd.push_back(x[i + 1]);
  }
  even = fft(std::move(even));
  odd = fft(std::move(odd));
  for (std::size_t k = 0; k < n / 2; ++k) {
    const auto turned = std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n));
    x[k] = even[k] + turned * odd[k];
    x[k + n / 2] = even[k] - turned * odd[k];
  }
  return x;
}

// Strongest frequency: Hann window, a parabola through the logarithms of three bins. Needs a power of two of samples.
inline double pitch_hz(std::span<const double> samples, double rate_hz) {
  const std::size_t n = samples.size();
  std::vector<std::complex<double>> windowed;
  for (std::size_t i = 0; i < n; ++i) {
    const double hann = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n));
    windowed.emplace_back(hann * samples[i]);
  }
  const auto spectrum = fft(std::move(windowed));
  std::size_t best = 1;
  for (std::size_t k = 1; k + 1 < n / 2; ++k) best = std::abs(spectrum[k]) > std::abs(spectrum[best]) ? k : best;
  const auto level = [&](std::size_t k) { return std::log(std::abs(spectrum[k]) + 1e-300); };
  const double a = level(best - 1), b = level(best), c = level(best + 1);
  const double shift = 0.5 * (a - c) / (a - 2.0 * b + c);
  return (static_cast<double>(best) + shift) * rate_hz / static_cast<double>(n);
}

// Amplitude of one frequency (Goertzel), over whole periods of it.
inline double amplitude(std::span<const double> samples, double hz, double rate_hz) {
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    sum += samples[i] * std::polar(1.0, -2.0 * std::numbers::pi * hz * static_cast<double>(i) / rate_hz);
  }
  return 2.0 * std::abs(sum) / static_cast<double>(samples.size());
}

inline double cents(double hz, double reference_hz) { return 1200.0 * std::log2(hz / reference_hz); }

inline double rms(std::span<const double> samples) {
  double sum = 0;
  for (const double sample : samples) sum += sample * sample;
  return samples.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(samples.size()));
}

inline double largest_step(std::span<const double> samples) {
  double largest = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) largest = std::max(largest, std::abs(samples[i] - samples[i - 1]));
  return largest;
}

inline std::vector<float> floats_of(const std::string& bytes) {
  std::vector<float> samples(bytes.size() / sizeof(float));
  std::memcpy(samples.data(), bytes.data(), samples.size() * sizeof(float));
  return samples;
}

}  // namespace afm::test
