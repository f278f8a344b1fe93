// SPDX-License-Identifier: Apache-2.0
#include "curves/parameter_build.h"

#include <chrono>
#include <utility>

namespace afm::curves {

void ParameterBuild::step(const LiveParameters& now, LiveParameters::Row row, int direction) {
  waiting_.push_back({row, direction});
  if (!built_.valid()) begin(now);
}

void ParameterBuild::begin(LiveParameters from) {
  dropped_ = false;
  built_ = std::async(std::launch::async,
                      [next = std::move(from), steps = std::exchange(waiting_, {})]() mutable -> LiveParameters {
                        for (const Step& step : steps) next.step(step.row, step.direction);
                        return std::move(next);
                      });
}

std::optional<LiveParameters> ParameterBuild::take(const LiveParameters& now) {
  std::optional<LiveParameters> built;
  if (built_.valid()) {
    if (built_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
    LiveParameters next = built_.get();
    if (!dropped_) built = std::move(next);
  }
  if (!waiting_.empty()) begin(built ? *built : now);
  return built;
}

void ParameterBuild::drop() {
  dropped_ = true;
  waiting_.clear();
}

}  // namespace afm::curves
