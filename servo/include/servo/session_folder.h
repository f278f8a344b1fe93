// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "core/result.h"
#include "servo/session_file.h"
#include "servo/session_writer.h"

namespace afm::servo {

// Where sessions are kept as they come: session-NAME.afms, then session-NAME-2.afms; what lies there already is left
// alone. Each grows while it is felt (SessionWriter). One thread.
class SessionFolder {
 public:
  // Makes it. Fails at once if it cannot be written.
  static core::Result<SessionFolder> open(const std::string& path);

  // What has come of the session under way since the last call; its first part names it. The file of a session without
  // force goes when it ends.
  core::Result<void> add(const RecordedSession& part);

  // The session under way is over; the log says where it is.
  core::Result<void> end();

 private:
  struct Growing {
    SessionWriter writer;
    std::int64_t begin_ns = 0;
    std::int64_t end_ns = 0;
    std::size_t events = 0;
    bool had_force = false;
  };

  explicit SessionFolder(std::string path) : path_(std::move(path)) {}
  core::Result<SessionWriter> new_file(const RecordedSession& part) const;

  std::string path_;
  std::optional<Growing> growing_;
};

}  // namespace afm::servo
