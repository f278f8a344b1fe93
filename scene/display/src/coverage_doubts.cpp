// SPDX-License-Identifier: Apache-2.0
#include "coverage_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

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

Seen seen_on(const std::vector<Output>& outputs, std::size_t screen) {
  Seen seen;
  for (const Output& output : outputs) {
    if (output.screen != screen) continue;
    seen.left = seen.left || output.mode != StereoMode::Right;
    seen.right = seen.right || output.mode != StereoMode::Left;
  }
  return seen;
}

// Reports a screen whose corners were copied from another and not changed, unless each has an eye.
void doubt_places(const Wall& wall, const std::vector<Seen>& seen, std::vector<std::string>& doubts) {
  for (std::size_t i = 0; i < wall.screens.size(); ++i) {
    for (std::size_t j = i + 1; j < wall.screens.size(); ++j) {
      const Screen &a = wall.screens[i], &b = wall.screens[j];
      const bool is_pair =
          seen[i].left != seen[i].right && seen[i].left == seen[j].right && seen[i].right == seen[j].left;
      if (!at_one_place(a, b) || is_pair) continue;
      doubts.push_back(fmt::format(
          "screens \"{}\" and \"{}\" are at one place ({:.0f} mm apart) and show the same part of the scene: check the "
          "corners; for two outputs with one picture, give both outputs the same screen",
          a.name, b.name, apart_m(a, b) * 1e3));
    }
  }
}

// Reports screens that nobody sees, or with one eye only.
void doubt_seen(const Wall& wall, const std::vector<Seen>& seen, std::vector<std::string>& doubts) {
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
    } else if (here.left != here.right) {
      const char* const missing = here.left ? "right" : "left";
      doubts.push_back(
          fmt::format("screen \"{}\" has no output for the {} eye: add an [[output]] with mode = \"{}\", or "
                      "use another mode",
                      name, missing, missing));
    }
  }
}

}  // namespace

void doubt_coverage(const Wall& wall, std::vector<std::string>& doubts) {
  const std::vector<Output> outputs = outputs_of(wall);
  std::vector<Seen> seen;
  seen.reserve(wall.screens.size());
  for (std::size_t i = 0; i < wall.screens.size(); ++i) seen.push_back(seen_on(outputs, i));
  doubt_places(wall, seen, doubts);
  if (outputs.empty()) return;  // every screen has a window
  doubt_seen(wall, seen, doubts);
  for (std::size_t node = 0; node < wall.nodes.size(); ++node) {
    if (std::any_of(outputs.begin(), outputs.end(), [&](const Output& output) { return output.node == node; }))
      continue;
    doubts.push_back(
        fmt::format("node \"{0}\" has no output, so it shows nothing: add node = \"{0}\" to its [[output]]",
                    wall.nodes[node].name));
  }
}

}  // namespace afm::scene
