// SPDX-License-Identifier: Apache-2.0
#include "servo/session_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "core/log.h"

namespace afm::servo {

core::Result<SessionFolder> SessionFolder::open(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (!std::filesystem::is_directory(path, error) || ::access(path.c_str(), W_OK | X_OK) != 0) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot record into {}: it is no folder that can be written; name another", path));
  }
  return SessionFolder(path);
}

core::Result<void> SessionFolder::keep(const RecordedSession& session) {
  const bool had_force =
      std::any_of(session.samples.begin(), session.samples.end(),
                  [](const scene::TipSample& sample) { return sample.servo_state == scene::ServoState::Running; });
  if (!had_force) return {};
  std::string file = fmt::format("{}/session-{}.afms", path_, session.material);
  for (int number = 2; std::filesystem::exists(file); ++number) {
    file = fmt::format("{}/session-{}-{}.afms", path_, session.material, number);
  }
  if (auto saved = save_session(session, file); !saved) return saved;
  core::log_line(fmt::format("recorded: {}, {:.1f} s, {} events", file,
                             session.seconds_since_start(session.samples.back().time_ns), session.events.size()));
  return {};
}

}  // namespace afm::servo
