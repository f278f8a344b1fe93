// SPDX-License-Identifier: Apache-2.0
#include "render/eye_memory.h"

#include "device/device.h"

namespace afm::render {

double eye_memory_bytes(glm::uvec2 eye_px, std::uint32_t samples) {
  // multisampled and resolved images
  const double images = 2.0 * (4.0 + 4.0) * (samples > 1 ? 1.0 + samples : 1.0);
  return images * static_cast<double>(eye_px.x) * static_cast<double>(eye_px.y);
}

std::uint32_t samples_within_memory(Context& context, glm::uvec2 eye_px) {
  const double picture_bytes = 0.5 * eye_memory_bytes(eye_px, 1);
  const double most_bytes = static_cast<double>(context.device().largest_heap_bytes());
  return eye_memory_bytes(eye_px, 4) + picture_bytes > most_bytes ? 1 : 4;
}

}  // namespace afm::render
