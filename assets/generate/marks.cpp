// SPDX-License-Identifier: Apache-2.0
#include "beam.h"
#include "models.h"

namespace afm::generate {

// Lines of light that stand where something is to be read: neither lit nor shadowed, but hidden by what is before them.
Model marks() {
  Model model{"marks", {}};
  model.nodes.push_back(
      {.name = "line",
       .parts = {{unit_beam(), {.name = "pale line", .base_color = {0.72, 0.80, 0.88}, .alpha = 0.9, .unlit = true}}},
       .extras = mark_role()});
  model.nodes.push_back(
      {.name = "bend",
       .parts = {{unit_beam(),
                  {.name = "orange line", .base_color = {0.95, 0.38, 0.02}, .alpha = 0.95, .unlit = true}}},
       .extras = mark_role()});
  return model;
}

}  // namespace afm::generate
