// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace afm::physics {

// Normally distributed numbers, mean 0, variance 1, with the same sequence for the same seed on every machine, which
// std::normal_distribution does not guarantee. xoshiro256++ (Blackman & Vigna 2021) feeds a ziggurat of 256 layers
// (Marsaglia & Tsang 2000, with layer and abscissa from different bits, after Doornik 2005). Trivially copyable, a few
// nanoseconds per number, no allocation. One thread per object.
class NormalGenerator {
 public:
  // Any seed is valid; neighbouring seeds give unrelated sequences.
  explicit NormalGenerator(std::uint64_t seed) noexcept;

  double operator()() noexcept {
    const std::uint64_t bits = next();
    const std::size_t layer = bits & 0xff;
    const double uniform = unit(bits);
    const double x = uniform * layers_->edge[layer];
    // in 99 % of cases the whole layer is below the bell curve
    if (x < layers_->edge[layer + 1]) [[likely]]
      return (bits & 0x100) != 0 ? -x : x;
    return at_the_rim(layer, x, (bits & 0x100) != 0);
  }

 private:
  // Layer i spans 0 to edge[i]; its top is the bell's height above edge[i + 1]. Layer 0 is the base with the tail, its
  // edge that of a rectangle of the same area.
  struct Layers {
    std::array<double, 257> edge{};
    std::array<double, 257> height{};  // height of the bell curve, exp(-edge^2/2)
    Layers() noexcept;
  };

  // Number from 0 to below 1 from the upper 53 bits, which the layer and the sign do not use.
  static double unit(std::uint64_t bits) noexcept { return static_cast<double>(bits >> 11) * 0x1p-53; }

  std::uint64_t next() noexcept {
    const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

  double at_the_rim(std::size_t layer, double x, bool negative) noexcept;

  const Layers* layers_;  // tables shared by all generators
  std::array<std::uint64_t, 4> state_{};
};

}  // namespace afm::physics
