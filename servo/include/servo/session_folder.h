// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "core/result.h"
#include "servo/session_file.h"

namespace afm::servo {

// Where sessions are kept as they come: session-NAME.afms, then session-NAME-2.afms; each is written whole, and what
// lies there already is left alone. One thread.
class SessionFolder {
 public:
  // Makes it. Fails at once if it cannot be written.
  static core::Result<SessionFolder> open(const std::string& path);

  // Keeps a session in which the force was on, and says where in the log; forgets any other.
  core::Result<void> keep(const RecordedSession& session);

 private:
  explicit SessionFolder(std::string path) : path_(std::move(path)) {}

  std::string path_;
};

}  // namespace afm::servo
