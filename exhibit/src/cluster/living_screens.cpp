// SPDX-License-Identifier: Apache-2.0
#include "exhibit/cluster/living_screens.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

namespace afm::exhibit {

namespace {

using glm::dvec3;

constexpr double kSameDirection = 0.999;
constexpr double kTapeM = 0.02;        // accuracy of a wall measured by tape
constexpr double kLeastCrossed = 0.5;  // smallest fraction of the banner's height on a screen that shows it
constexpr double kSeamShare = 0.02;    // gap between two screens, relative to the banner's width
constexpr double kRimShare = 0.01;     // gap to the rim of a screen, relative to the banner's width

// A stretch of the wall, in units of the banner's width; the banner extends from 0 to 1.
struct Stretch {
  double from = 0, to = 0;
  double length() const { return to - from; }
};

bool draws(const scene::Wall& wall, std::size_t screen, const AbsentMachines& absent) {
  const auto on_screen = [&](const scene::Output& output) {
    if (output.screen != screen) return false;
    return output.node ? (absent.nodes >> *output.node & 1U) == 0 : !absent.master;
  };
  return std::any_of(wall.outputs.begin(), wall.outputs.end(), on_screen) ||
         std::any_of(wall.outputs_elsewhere.begin(), wall.outputs_elsewhere.end(), on_screen);
}

// Stretch of this screen, if the banner is in its plane and on it.
std::optional<Stretch> crossed(const render::PanelPlacement& banner, const scene::Screen& screen) {
  const double width_m = glm::length(banner.right_m), height_m = glm::length(banner.up_m);
  const dvec3 right = banner.right_m / width_m, up = banner.up_m / height_m, out = glm::cross(right, up);
  const dvec3 low = screen.lower_left - banner.lower_left_m;
  const dvec3 across = screen.lower_right - screen.lower_left, upwards = screen.upper_left - screen.lower_left;
  if (glm::dot(glm::normalize(across), right) < kSameDirection || std::abs(glm::dot(low, out)) > kTapeM) return {};
  const double bottom_m = std::max(0.0, glm::dot(low, up));
  const double top_m = std::min(height_m, glm::dot(low + upwards, up));
  const Stretch part{glm::dot(low, right) / width_m, glm::dot(low + across, right) / width_m};
  if (top_m - bottom_m < kLeastCrossed * height_m || part.from >= 1.0 || part.to <= 0.0) return {};
  return part;
}

// Widest stretch, extended by those that adjoin it.
Stretch widest(std::vector<Stretch> parts) {
  std::sort(parts.begin(), parts.end(), [](const Stretch& a, const Stretch& b) { return a.from < b.from; });
  Stretch best, now = parts.front();
  for (const Stretch& part : parts) {
    if (part.from > now.to + kSeamShare) now = part;
    now.to = std::max(now.to, part.to);
    if (now.length() > best.length()) best = now;
  }
  return best;
}

render::PanelPlacement at_top_of(const scene::Screen& screen, const render::PanelPlacement& banner) {
  const dvec3 right = glm::normalize(screen.lower_right - screen.lower_left);
  const dvec3 up = glm::cross(screen.normal(), right);
  const double gap_m = kRimShare * screen.width_m();
  const double width_m = std::min(glm::length(banner.right_m), screen.width_m() - 2.0 * gap_m);
  const double height_m = std::min(glm::length(banner.up_m), screen.height_m() - 2.0 * gap_m);
  return {.lower_left_m = screen.upper_left + 0.5 * (screen.width_m() - width_m) * right - (gap_m + height_m) * up,
          .right_m = width_m * right,
          .up_m = height_m * up};
}

}  // namespace

render::PanelPlacement on_living_screens(const render::PanelPlacement& banner, const scene::Wall& wall,
                                         const AbsentMachines& absent) {
  const bool all_there = absent.nodes == 0 && !absent.master;
  if (all_there || banner == render::kNoPlacement) return banner;
  std::vector<Stretch> parts;
  const scene::Screen* largest = nullptr;
  const auto area_m2 = [](const scene::Screen& screen) { return screen.width_m() * screen.height_m(); };
  for (std::size_t i = 0; i < wall.screens.size(); ++i) {
    const scene::Screen& screen = wall.screens[i];
    if (!draws(wall, i, absent)) continue;
    if (const auto part = crossed(banner, screen)) parts.push_back(*part);
    if (largest == nullptr || area_m2(screen) > 1.001 * area_m2(*largest)) largest = &screen;
  }
  if (largest == nullptr) return banner;
  if (parts.empty()) return at_top_of(*largest, banner);
  const Stretch part = widest(std::move(parts));
  if (part.from <= 0.0 && part.to >= 1.0) return banner;
  // banner as wide as before, if there is room, and as near as possible to its former place
  const double rim = std::min(kRimShare, 0.25 * part.length());
  const double width = std::min(1.0, part.length() - 2.0 * rim);
  const double from = std::max(part.from + rim, std::min(0.0, part.to - rim - width));
  render::PanelPlacement living = banner;
  living.lower_left_m += from * banner.right_m;
  living.right_m *= width;
  return living;
}

}  // namespace afm::exhibit
