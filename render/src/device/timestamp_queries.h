// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "device/device.h"

namespace afm::render {

// Moments at which the device reached places in commands, by its own clock.
class TimestampQueries {
 public:
  static bool works_on(const Device& device);

  TimestampQueries(const Device& device, std::uint32_t marks);

  // Forgets the marks of an earlier frame, before they are set again. Outside any rendering.
  void reset(const vk::raii::CommandBuffer& command, std::uint32_t first, std::uint32_t count) const;

  // Set once all commands before it are done. Outside any rendering.
  void mark(const vk::raii::CommandBuffer& command, std::uint32_t mark) const;

  // Of commands that are done and set both.
  double between_ms(std::uint32_t begin, std::uint32_t end) const;

 private:
  double ms_per_tick_;
  vk::raii::QueryPool queries_;
};

}  // namespace afm::render
