// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "fuzz/accepted.h"
#include "fuzz/memory_file.h"
#include "scene/display/wall.h"

// Whatever the bytes: a wall that both eyes of every viewer can be drawn for, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace afm::scene;
  const afm::fuzz::MemoryFile file(bytes, size);
  const auto wall = load_wall(file.path());
  if (!wall) return 0;
  ++afm::fuzz::accepted_inputs;
  for (const Viewer& viewer : wall->viewers) {
    for (const Screen& screen : wall->screens) {
      for (const Eye eye : kEyes) {
        const auto view = off_axis_view(screen, eye_position(viewer.sweet_spot, eye, viewer.ipd_m),
                                        DepthConvention::VulkanReversedInfinite, kNearM, 0.0);
        if (!view) std::abort();
      }
    }
  }
  for (const Output& output : wall->outputs) {
    if (output.screen >= wall->screens.size() || (output.eye.has_value() != (output.mode == StereoMode::Dual)))
      std::abort();
    if (!output.blend) continue;
    const Blend::Place middle = output.blend->at({0.5, 0.5});
    if (output.blend->fields.size() > Blend::kMostScreens || !(middle.all > 0.0) || !(middle.own <= middle.all))
      std::abort();
  }
  return 0;
}
