// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>

#include "servo/session_file.h"
#include "support/stall_watch.h"

namespace afm::support {

// Time from an instant of the monotonic clock to the first tick without force, by a session's file, with the longest
// stall that `watch` saw meanwhile. Fails the test without such a tick.
inline Timed dark_after(std::int64_t begin_ns, const std::string& session_file, const StallWatch& watch) {
  const auto session = servo::load_session(session_file);
  EXPECT_TRUE(session) << session.error().message;
  if (!session) return {};
  const auto dark = std::find_if(session->samples.begin(), session->samples.end(), [&](const scene::TipSample& s) {
    return s.time_ns > begin_ns && s.servo_state == scene::ServoState::Disarmed;
  });
  EXPECT_NE(dark, session->samples.end());
  if (dark == session->samples.end()) return {};
  return {std::chrono::nanoseconds(dark->time_ns - begin_ns), watch.longest_between(begin_ns, dark->time_ns)};
}

}  // namespace afm::support
