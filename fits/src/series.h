// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "fits/indenter.h"
#include "lanes.h"

namespace afm::fits {

// Lever and contact in series (F7): d + F(d)/k = way, without adhesion.
struct InSeries {
  double depth_m = 0;
  Push push;  // push at depth_m
};

// Solves for the way of the base beyond the contact point, `way_m` > 0. The search begins at the depth `near_m`.
InSeries in_series(const Indenter& indenter, double modulus_pa, double spring_n_per_m, double way_m, double near_m);

// Lever and contact in series at many ways of one contact, four at once where the force is a power of the depth.
class PressedLever {
 public:
  PressedLever(const Indenter& indenter, double modulus_pa, double spring_n_per_m);

  static constexpr std::size_t kAtOnce = 4;
  using Four = std::array<Two, 2>;
  struct Pressed {
    Four depth_m{}, force_n{};
    Four slope_n_per_m{};  // stiffness of the contact without the lever
  };
  // Solves for four ways. `root`: roots of the depths from which the search begins, positive; replaced by the result's.
  void at(const Four& way_m, Four& root, Pressed& pressed) const;

 private:
  void blunt_at(const Four& way_m, Four& root, Pressed& pressed) const;
  void sharp_at(const Four& way_m, Pressed& pressed) const;

  const Indenter& indenter_;
  std::optional<PowerLaw> power_;
  double modulus_pa_, spring_n_per_m_;
};

}  // namespace afm::fits
