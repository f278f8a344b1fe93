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

// Folder that sessions are recorded into: session-NAME.afms, then session-NAME-2.afms. Never overwrites a file. Each
// file grows during its session (SessionWriter). One thread.
class SessionFolder {
 public:
  // Creates the folder. Fails at once if it is not writable.
  static core::Result<SessionFolder> open(const std::string& path);

  // Adds a part of the current session; the first part determines its name. The file of a session without force is
  // deleted when the session ends.
  core::Result<void> add(const RecordedSession& part);

  // Ends the current session; logs the path of its file.
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
