// SPDX-License-Identifier: Apache-2.0
#include "physics/normal_generator.h"

#include <cmath>
#include <numbers>

namespace afm::physics {
namespace {

// Beginning of the tail of a ziggurat of 256 layers under exp(-x^2/2) (Marsaglia & Tsang 2000).
constexpr double kTail = 3.6541528853610088;

double bell(double x) { return std::exp(-0.5 * x * x); }

}  // namespace

NormalGenerator::Layers::Layers() noexcept {
  // every layer has the area of the base with its tail
  const double area = kTail * bell(kTail) + std::sqrt(0.5 * std::numbers::pi) * std::erfc(kTail / std::numbers::sqrt2);
  edge[0] = area / bell(kTail);
  edge[1] = kTail;
  for (std::size_t i = 2; i < 256; ++i) {
    edge[i] = std::sqrt(-2.0 * std::log(area / edge[i - 1] + bell(edge[i - 1])));
  }
  edge[256] = 0.0;
  for (std::size_t i = 0; i < edge.size(); ++i) height[i] = bell(edge[i]);
}

NormalGenerator::NormalGenerator(std::uint64_t seed) noexcept {
  static const Layers layers;
  layers_ = &layers;

  // splitmix64 (Steele, Lea & Flood 2014) spreads the seed, so that no state is all zero
  for (std::uint64_t& word : state_) {
    seed += 0x9e3779b97f4a7c15ULL;
    std::uint64_t mixed = seed;
    mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9ULL;
    mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebULL;
    word = mixed ^ (mixed >> 31);
  }
}

double NormalGenerator::at_the_rim(std::size_t layer, double x, bool negative) noexcept {
  if (layer == 0) {
    // the tail beyond the base, by exponentials (Marsaglia 1964); 1 - u is never 0
    double beyond = 0.0, height = 0.0;
    do {
      beyond = -std::log(1.0 - unit(next())) / kTail;
      height = -std::log(1.0 - unit(next()));
    } while (2.0 * height < beyond * beyond);
    return negative ? -(kTail + beyond) : kTail + beyond;
  }
  const double bottom = layers_->height[layer], top = layers_->height[layer + 1];
  if (bottom + unit(next()) * (top - bottom) < std::exp(-0.5 * x * x)) return negative ? -x : x;
  return (*this)();
}

}  // namespace afm::physics
