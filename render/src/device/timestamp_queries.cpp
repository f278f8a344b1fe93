// SPDX-License-Identifier: Apache-2.0
#include "device/timestamp_queries.h"

#include "core/check.h"

namespace afm::render {

bool TimestampQueries::works_on(const Device& device) {
  return device.physical().getQueueFamilyProperties()[device.queue_family()].timestampValidBits > 0;
}

// Allocates one query more than there are marks: lavapipe 25.0 (Debian 13) writes one beyond the end of a pool's
// memory.
TimestampQueries::TimestampQueries(const Device& device, std::uint32_t marks)
    : ms_per_tick_(1e-6 * static_cast<double>(device.physical().getProperties().limits.timestampPeriod)),
      queries_(*device, vk::QueryPoolCreateInfo{.queryType = vk::QueryType::eTimestamp, .queryCount = marks + 1}) {}

void TimestampQueries::reset(const vk::raii::CommandBuffer& command, std::uint32_t first, std::uint32_t count) const {
  command.resetQueryPool(*queries_, first, count);
}

void TimestampQueries::mark(const vk::raii::CommandBuffer& command, std::uint32_t mark) const {
  command.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *queries_, mark);
}

double TimestampQueries::between_ms(std::uint32_t begin, std::uint32_t end) const {
  const std::uint32_t count = end - begin + 1;
  const auto [result, ticks] =
      queries_.getResults<std::uint64_t>(begin, count, count * sizeof(std::uint64_t), sizeof(std::uint64_t),
                                         vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
  AFM_CHECK(result == vk::Result::eSuccess);
  return static_cast<double>(ticks.back() - ticks.front()) * ms_per_tick_;
}

}  // namespace afm::render
