// SPDX-License-Identifier: Apache-2.0
#include "pass_clock.h"

namespace afm::render {
namespace {

constexpr std::uint32_t kMarks = 5;
constexpr std::uint32_t kPanelMarks = 2;

}  // namespace

PassClock::PassClock(const Device& device) : stopwatch_(device, kMarks) {}

void PassClock::mark(const vk::raii::CommandBuffer& command, Mark mark) const {
  if (mark == Mark::PanelsBegin) {
    stopwatch_.reset(command, 0, kPanelMarks);
  } else if (mark == Mark::ShadowBegin) {
    stopwatch_.reset(command, kPanelMarks, kMarks - kPanelMarks);
  }
  stopwatch_.mark(command, static_cast<std::uint32_t>(mark));
}

double PassClock::between_ms(Mark begin, Mark end) const {
  return stopwatch_.between_ms(static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end));
}

PassTimes PassClock::times(bool panels_painted) const {
  return {.panels_ms = panels_painted ? between_ms(Mark::PanelsBegin, Mark::PanelsEnd) : 0.0,
          .shadow_ms = between_ms(Mark::ShadowBegin, Mark::ShadowEnd),
          .eyes_ms = between_ms(Mark::ShadowEnd, Mark::EyesEnd)};
}

}  // namespace afm::render
