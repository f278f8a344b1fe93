// SPDX-License-Identifier: Apache-2.0
#include "exact_math.h"

#include <algorithm>

namespace afm::generate {

double smooth_step(double low, double high, double value) {
  const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return t * t * t * (t * (t * 6 - 15) + 10);
}

std::vector<V2> arc(V2 from, V2 to, int halvings) {
  std::vector<V2> directions{from, to};
  for (int i = 0; i < halvings; ++i) {
    std::vector<V2> finer{directions.front()};
    for (std::size_t k = 1; k < directions.size(); ++k) {
      finer.push_back(unit(directions[k - 1] + directions[k]));
      finer.push_back(directions[k]);
    }
    directions = std::move(finer);
  }
  return directions;
}

double random_unit(std::int64_t column, std::int64_t row, std::uint32_t seed) {
  // the finaliser of MurmurHash3 (Appleby, 64 bits) over the mixed arguments
  std::uint64_t h = static_cast<std::uint64_t>(column) * 0x9E3779B97F4A7C15ULL ^
                    static_cast<std::uint64_t>(row) * 0xC2B2AE3D27D4EB4FULL ^ (std::uint64_t{seed} << 32U);
  h = (h ^ (h >> 33U)) * 0xFF51AFD7ED558CCDULL;
  h = (h ^ (h >> 33U)) * 0xC4CEB9FE1A85EC53ULL;
  h ^= h >> 33U;
  return static_cast<double>(h >> 40U) / static_cast<double>(1U << 24U);
}

double noise(double x, double y, std::uint32_t seed) {
  const double column = std::floor(x), row = std::floor(y);
  const auto corner = [&](int right, int up) {
    return 2 * random_unit(static_cast<std::int64_t>(column) + right, static_cast<std::int64_t>(row) + up, seed) - 1;
  };
  const double u = smooth_step(0, 1, x - column), v = smooth_step(0, 1, y - row);
  return mix(mix(corner(0, 0), corner(1, 0), u), mix(corner(0, 1), corner(1, 1), u), v);
}

}  // namespace afm::generate
