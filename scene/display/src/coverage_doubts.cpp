// SPDX-License-Identifier: Apache-2.0
#include "coverage_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

namespace afm::scene {

namespace {

constexpr double kSamePlace = 0.1;  // distance of two screens, relative to the diagonal of the smaller one

// Outputs of all machines.
std::vector<Output> outputs_of(const Wall& wall) {
  std::vector<Output> outputs = wall.outputs;
  outputs.insert(outputs.end(), wall.outputs_elsewhere.begin(), wall.outputs_elsewhere.end());
  return outputs;
}

double apart_m(const Screen& a, const Screen& b) {
  return std::max(glm::distance(a.lower_left, b.lower_left), glm::distance(a.center(), b.center()));
}

bool at_one_place(const Screen& a, const Screen& b) {
  const double diagonal_m = std::min(std::hypot(a.width_m(), a.height_m()), std::hypot(b.width_m(), b.height_m()));
  return apart_m(a, b) <= kSamePlace * diagonal_m;
}

// Eyes that see a screen.
struct Seen {
  bool left = false, right = false;
};

// The eye that alone sees an output; empty for one with pictures of both, or one for both.
std::optional<Eye> only_eye_of(const Output& output) {
  std::optional<Eye> eye = output.eye;
  if (output.mode == StereoMode::Left) eye = Eye::Left;
  if (output.mode == StereoMode::Right) eye = Eye::Right;
  if (!eye || output.order == EyeOrder::Straight) return eye;
  return *eye == Eye::Left ? Eye::Right : Eye::Left;
}

Seen seen_on(const std::vector<Output>& outputs, std::size_t screen) {
  Seen seen;
  for (const Output& output : outputs) {
    if (output.screen != screen) continue;
    const std::optional<Eye> only = only_eye_of(output);
    seen.left = seen.left || only != Eye::Right;
    seen.right = seen.right || only != Eye::Left;
  }
  return seen;
}

// True if some of several outputs of a screen are swapped, and some not.
bool are_swapped_in_part(const std::vector<Output>& outputs, std::size_t screen) {
  const auto has = [&](EyeOrder order) {
    return std::any_of(outputs.begin(), outputs.end(),
                       [&](const Output& output) { return output.screen == screen && output.order == order; });
  };
  return has(EyeOrder::Straight) && has(EyeOrder::Swapped);
}

// PlaceOnScreen of a screen along the edges of another, in metres from its lower left corner.
struct PlaceOnScreen {
  glm::dvec2 least, most;
};
PlaceOnScreen place_on(const Screen& on, const Screen& screen) {
  const glm::dvec3 right = glm::normalize(on.lower_right - on.lower_left),
                   up = glm::normalize(on.upper_left - on.lower_left);
  const auto place = [&](const glm::dvec3& corner) {
    return glm::dvec2(glm::dot(corner - on.lower_left, right), glm::dot(corner - on.lower_left, up));
  };
  const glm::dvec2 a = place(screen.lower_left), b = place(screen.lower_right), c = place(screen.upper_left);
  return {glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))};
}

// True if a screen is within another one of the same plane.
bool is_within(const Screen& small, const Screen& large) {
  constexpr double kTape = 0.01;  // accuracy of a tape measure, in metres
  if (!in_one_plane(large, small)) return false;
  const PlaceOnScreen extent = place_on(large, small);
  return extent.least.x >= -kTape && extent.least.y >= -kTape && extent.most.x <= large.width_m() + kTape &&
         extent.most.y <= large.height_m() + kTape;
}

// Reports a screen whose corners were copied from another and not changed, unless each has an eye.
void doubt_places(const Wall& wall, const std::vector<Seen>& seen, std::vector<std::string>& doubts) {
  for (std::size_t i = 0; i < wall.screens.size(); ++i) {
    for (std::size_t j = i + 1; j < wall.screens.size(); ++j) {
      const Screen &a = wall.screens[i], &b = wall.screens[j];
      const bool is_pair =
          seen[i].left != seen[i].right && seen[i].left == seen[j].right && seen[i].right == seen[j].left;
      if (is_pair) continue;
      if (!at_one_place(a, b)) {
        const bool first = is_within(a, b);
        if (!first && !is_within(b, a)) continue;
        doubts.push_back(fmt::format(
            "screen \"{}\" lies within screen \"{}\", and both show this part of the scene: check the corners",
            first ? a.name : b.name, first ? b.name : a.name));
        continue;
      }
      doubts.push_back(fmt::format(
          "screens \"{}\" and \"{}\" are at one place ({:.0f} mm apart) and show the same part of the scene: check the "
          "corners; for two outputs with one picture, give both outputs the same screen",
          a.name, b.name, apart_m(a, b) * 1e3));
    }
  }
}

// Reports screens that nobody sees, or with one eye only.
void doubt_seen(const Wall& wall, const std::vector<Output>& outputs, const std::vector<Seen>& seen,
                std::vector<std::string>& doubts) {
  for (std::size_t i = 0; i < wall.screens.size(); ++i) {
    Seen here = seen[i];
    for (std::size_t j = 0; j < wall.screens.size(); ++j) {
      if (!at_one_place(wall.screens[i], wall.screens[j])) continue;
      here.left = here.left || seen[j].left;
      here.right = here.right || seen[j].right;
    }
    const std::string& name = wall.screens[i].name;
    if (!seen[i].left && !seen[i].right) {
      doubts.push_back(
          fmt::format("screen \"{0}\" has no output, so nothing is drawn for it: add an [[output]] with "
                      "screen = \"{0}\", or remove the screen",
                      name));
    } else if (here.left != here.right && are_swapped_in_part(outputs, i)) {
      doubts.push_back(
          fmt::format("every output of screen \"{}\" shows the {} eye: set swap = true for both outputs "
                      "of a pair, or for neither",
                      name, here.left ? "left" : "right"));
    } else if (here.left != here.right) {
      const char* const missing = here.left ? "right" : "left";
      doubts.push_back(
          fmt::format("screen \"{}\" has no output for the {} eye: add an [[output]] with mode = \"{}\", or "
                      "use another mode",
                      name, missing, missing));
    }
  }
}

// Reports tiles whose common middle, where the tip is, is in a gap wider than the frames of monitors.
void doubt_gap(const Wall& wall, std::vector<std::string>& doubts) {
  constexpr double kFramesM = 0.1;
  for (std::size_t i = 0; i < wall.screens.size(); ++i) {
    const Screen& first = wall.screens[i];
    const auto in_plane = [&](const Screen& screen) { return in_one_plane(first, screen); };
    if (std::any_of(wall.screens.begin(), wall.screens.begin() + static_cast<std::ptrdiff_t>(i), in_plane)) continue;
    double least = 0.0, most = first.width_m();
    for (const Screen& screen : wall.screens) {
      if (!in_plane(screen)) continue;
      least = std::min(least, place_on(first, screen).least.x);
      most = std::max(most, place_on(first, screen).most.x);
    }
    const double middle = 0.5 * (least + most);
    const Screen *left = nullptr, *right = nullptr;
    for (const Screen& screen : wall.screens) {
      if (!in_plane(screen)) continue;
      const PlaceOnScreen extent = place_on(first, screen);
      if (extent.most.x < middle && extent.most.x >= least) {
        least = extent.most.x;
        left = &screen;
      } else if (extent.least.x > middle && extent.least.x <= most) {
        most = extent.least.x;
        right = &screen;
      } else if (extent.least.x <= middle && extent.most.x >= middle) {
        most = least;
        break;
      }
    }
    if (left == nullptr || right == nullptr || most - least < kFramesM) continue;
    doubts.push_back(fmt::format(
        "screens \"{}\" and \"{}\" count as one, and its middle, where the tip is, lies in the gap of {:.0f} "
        "mm between them, where nothing is drawn: move them together, or leave one out",
        left->name, right->name, (most - least) * 1e3));
  }
}

}  // namespace

void doubt_coverage(const Wall& wall, std::vector<std::string>& doubts) {
  const std::vector<Output> outputs = outputs_of(wall);
  std::vector<Seen> seen;
  seen.reserve(wall.screens.size());
  for (std::size_t i = 0; i < wall.screens.size(); ++i) seen.push_back(seen_on(outputs, i));
  doubt_places(wall, seen, doubts);
  doubt_gap(wall, doubts);
  if (outputs.empty()) return;  // every screen has a window
  doubt_seen(wall, outputs, seen, doubts);
  for (std::size_t node = 0; node < wall.nodes.size(); ++node) {
    if (std::any_of(outputs.begin(), outputs.end(), [&](const Output& output) { return output.node == node; }))
      continue;
    doubts.push_back(
        fmt::format("node \"{0}\" has no output, so it shows nothing: add node = \"{0}\" to its [[output]]",
                    wall.nodes[node].name));
  }
}

}  // namespace afm::scene
