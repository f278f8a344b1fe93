// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "physics/friction/sideways.h"
#include "physics/units.h"

// Drift of a sample below its scanner, and limits of an old picture of it (docs/manipulation.md). Any
// thread; nothing allocates.
namespace afm::physics {

// Order of magnitude of 0.01 to 0.1 nm/s at room temperature (Mokaberi & Requicha 2006); estimated.
inline constexpr Velocity kUsualDrift{0.05e-9};

// A straight drift at a constant rate. Its direction is the same on every machine for a seed.
class SampleDrift {
 public:
  SampleDrift(Velocity rate, std::uint64_t seed) noexcept;

  // Way of the sample below the scanner since the start (M60).
  Sideways<Length> after(Time elapsed) const noexcept;

 private:
  Sideways<Velocity> velocity_;
};

// Doubt about a place that was measured once, while an unknown drift goes on.
struct PlaceDoubt {
  Length at_first;  // sigma_0, standard deviation of the measurement
  Velocity rate;    // sigma_v, standard deviation of the unknown drift velocity

  // sigma(t) = sqrt(sigma_0^2 + (sigma_v t)^2) (M61).
  Length after(Time age) const noexcept;

  // The age at which the doubt reaches half a radius: an older picture is stale (M62). Infinite without drift, 0 if the
  // doubt is larger from the first.
  Time stale_after(Length radius) const noexcept;
};

// Time of so many lines of an image, each back and forth.
Time scan_time(std::size_t lines, Frequency line_rate) noexcept;

}  // namespace afm::physics
