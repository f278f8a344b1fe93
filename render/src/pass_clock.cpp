// SPDX-License-Identifier: Apache-2.0
#include "pass_clock.h"

#include "core/check.h"

namespace afm::render {
namespace {

constexpr std::uint32_t kMarks = 5;
constexpr std::uint32_t kPanelMarks = 2;

}  // namespace

bool PassClock::works_on(const Device& device) {
  return device.physical().getQueueFamilyProperties()[device.queue_family()].timestampValidBits > 0;
}

PassClock::PassClock(const Device& device)
    : ms_per_tick_(1e-6 * static_cast<double>(device.physical().getProperties().limits.timestampPeriod)),
      queries_(*device, vk::QueryPoolCreateInfo{.queryType = vk::QueryType::eTimestamp, .queryCount = kMarks}) {}

void PassClock::mark(const vk::raii::CommandBuffer& command, Mark mark) const {
  if (mark == Mark::PanelsBegin) {
    command.resetQueryPool(*queries_, 0, kPanelMarks);
  } else if (mark == Mark::ShadowBegin) {
    command.resetQueryPool(*queries_, kPanelMarks, kMarks - kPanelMarks);
  }
  command.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *queries_, static_cast<std::uint32_t>(mark));
}

double PassClock::between_ms(Mark begin, Mark end) const {
  const auto first = static_cast<std::uint32_t>(begin);
  const auto count = static_cast<std::uint32_t>(end) - first + 1;
  const auto [result, ticks] =
      queries_.getResults<std::uint64_t>(first, count, count * sizeof(std::uint64_t), sizeof(std::uint64_t),
                                         vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
  AFM_CHECK(result == vk::Result::eSuccess);
  return static_cast<double>(ticks.back() - ticks.front()) * ms_per_tick_;
}

PassTimes PassClock::times(bool panels_painted) const {
  return {.panels_ms = panels_painted ? between_ms(Mark::PanelsBegin, Mark::PanelsEnd) : 0.0,
          .shadow_ms = between_ms(Mark::ShadowBegin, Mark::ShadowEnd),
          .eyes_ms = between_ms(Mark::ShadowEnd, Mark::EyesEnd)};
}

}  // namespace afm::render
