// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <future>
#include <optional>
#include <vector>

#include "curves/live_parameters.h"

namespace afm::curves {

// Steps of parameters whose law takes longer than a frame to build, as that of a lever that taps does: a thread builds
// it, and no call waits. One thread; the destructor waits for the build, some tenths of a second.
class ParameterBuild {
 public:
  // Begins to build `now` with this step; while another build runs, the step waits for its end.
  void step(const LiveParameters& now, LiveParameters::Row row, int direction);

  bool running() const { return (built_.valid() && !dropped_) || !waiting_.empty(); }

  // Call once a frame: the parameters with the steps that have been built, or with the reason why the last one changed
  // nothing; empty if there are none. Then begins the steps that came meanwhile, from `now` if there are none.
  std::optional<LiveParameters> take(const LiveParameters& now);

  // Forgets every step that was not taken.
  void drop();

 private:
  struct Step {
    LiveParameters::Row row;
    int direction;
  };
  void begin(LiveParameters from);

  std::future<LiveParameters> built_;  // result of the running build; invalid: none is running
  bool dropped_ = false;               // true: the result of the running build is discarded
  std::vector<Step> waiting_;
};

}  // namespace afm::curves
