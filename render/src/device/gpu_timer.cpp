// SPDX-License-Identifier: Apache-2.0
#include "device/gpu_timer.h"

namespace afm::render {
namespace {

constexpr std::uint32_t kFrameMarks = 6;

}  // namespace

GpuTimer::GpuTimer(const Device& device) : stopwatch_(device, kFrameMarks) {}

void GpuTimer::mark(const vk::raii::CommandBuffer& command, Mark mark) const {
  if (mark == Mark::PanelsBegin || mark == Mark::ShadowBegin || mark == Mark::EyesBegin) {
    stopwatch_.reset(command, static_cast<std::uint32_t>(mark), 2);  // start mark together with its end mark
  }
  stopwatch_.mark(command, static_cast<std::uint32_t>(mark));
}

double GpuTimer::between_ms(Mark begin, Mark end) const {
  return stopwatch_.between_ms(static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end));
}

PassTimes GpuTimer::times(bool panels_painted, bool shadow_drawn, bool eyes_drawn) const {
  return {.panels_ms = panels_painted ? between_ms(Mark::PanelsBegin, Mark::PanelsEnd) : 0.0,
          .shadow_ms = shadow_drawn ? between_ms(Mark::ShadowBegin, Mark::ShadowEnd) : 0.0,
          .eyes_ms = eyes_drawn ? between_ms(Mark::EyesBegin, Mark::EyesEnd) : 0.0};
}

}  // namespace afm::render
