// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "beam.h"
#include "models.h"

namespace afm::generate {

namespace {

// A closed cone along z, from radius 1 at 0 to its point at 1.
Surface unit_head() {
  Surface surface;
  add_lathe(surface, {{1, 0, 1, 1}, {0, 1, 1, 1}}, 2);
  add_cap(surface, circle(1, 2), 0, Facing::Down);
  return surface;
}

MaterialSpec pale() { return {.name = "pale line", .base_color = {0.72, 0.80, 0.88}, .alpha = 0.9, .unlit = true}; }
MaterialSpec orange() {
  return {.name = "orange line", .base_color = {0.95, 0.38, 0.02}, .alpha = 0.95, .unlit = true};
}
MaterialSpec blue() { return {.name = "blue line", .base_color = {0.06, 0.42, 0.95}, .alpha = 0.95, .unlit = true}; }

}  // namespace

// Bright lines where something is to be read: neither lit nor shadowed, but hidden by objects in front of them.
Model marks() {
  Model model{"marks", {}};
  const auto add = [&](const char* name, Surface surface, MaterialSpec material) {
    model.nodes.push_back({.name = name, .parts = {{std::move(surface), std::move(material)}}, .extras = mark_role()});
  };
  // a pale line is seen on pale mica by its dark rim: lit, since unlit lines are in front of the journey, and blended,
  // so that it casts no shadow
  MaterialSpec rim = outline_material();
  rim.unlit = false;
  rim.alpha = 0.9;
  model.nodes.push_back(
      {.name = "line", .parts = {{unit_beam(), pale()}, {beam_outline(1.8), rim}}, .extras = mark_role()});
  add("push", unit_beam(), orange());
  add("push-head", unit_head(), orange());
  add("pull", unit_beam(), blue());
  add("pull-head", unit_head(), blue());
  return model;
}

}  // namespace afm::generate
