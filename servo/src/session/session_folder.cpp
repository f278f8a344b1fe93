// SPDX-License-Identifier: Apache-2.0
#include "servo/session_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "core/file_names.h"
#include "core/log.h"

namespace afm::servo {

core::Result<SessionFolder> SessionFolder::open(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (!std::filesystem::is_directory(path, error) || ::access(path.c_str(), W_OK | X_OK) != 0) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot record into {}: it is not a writable folder; choose another", path));
  }
  return SessionFolder(path);
}

core::Result<SessionWriter> SessionFolder::new_file(const RecordedSession& part) const {
  const std::string material = core::in_file_name(part.material);
  std::string file = fmt::format("{}/session-{}.afms", path_, material);
  for (int number = 2; std::filesystem::exists(std::filesystem::symlink_status(file)); ++number) {
    file = fmt::format("{}/session-{}-{}.afms", path_, material, number);
  }
  return SessionWriter::create(part, file);
}

core::Result<void> SessionFolder::add(const RecordedSession& part) {
  if (part.samples.empty()) return {};
  if (!growing_) {
    auto writer = new_file(part);
    if (!writer) return tl::unexpected(writer.error());
    growing_.emplace(Growing{.writer = std::move(*writer), .begin_ns = part.samples.front().time_ns});
  }
  growing_->end_ns = part.samples.back().time_ns;
  growing_->events += part.events.size();
  growing_->had_force = growing_->had_force || std::any_of(part.samples.begin(), part.samples.end(), [](const auto& s) {
                          return s.servo_state == scene::ServoState::Running;
                        });
  return growing_->writer.add(part);
}

core::Result<void> SessionFolder::end() {
  if (!growing_) return {};
  Growing ended = std::move(*growing_);
  growing_.reset();
  const double seconds = static_cast<double>(ended.end_ns - ended.begin_ns) * 1e-9;
  if (!ended.had_force) {
    ::unlink(ended.writer.path().c_str());
    core::log_line(fmt::format("not recorded: {}, {:.1f} s without force", ended.writer.path(), seconds));
    return {};
  }
  if (auto finished = ended.writer.finish(); !finished) return finished;
  core::log_line(fmt::format("recorded: {}, {:.1f} s, {} events", ended.writer.path(), seconds, ended.events));
  return {};
}

}  // namespace afm::servo
