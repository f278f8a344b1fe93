// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "device/device.h"

namespace afm::render {

// Times at which the device reached marks in the commands, by its own clock.
class TimestampQueries {
 public:
  static bool works_on(const Device& device);

  TimestampQueries(const Device& device, std::uint32_t marks);

  // Resets the marks of an earlier frame before they are set again. Call outside any rendering.
  void reset(const vk::raii::CommandBuffer& command, std::uint32_t first, std::uint32_t count) const;

  // Sets a mark once all earlier commands are done. Call outside any rendering.
  void mark(const vk::raii::CommandBuffer& command, std::uint32_t mark) const;

  // Time between two marks, both set by commands that are done.
  double between_ms(std::uint32_t begin, std::uint32_t end) const;

 private:
  double ms_per_tick_;
  vk::raii::QueryPool queries_;
};

}  // namespace afm::render
