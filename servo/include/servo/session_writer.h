// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/file_descriptor.h"
#include "core/result.h"
#include "servo/session_file.h"

namespace afm::servo {

class SessionEncoder;

// A session file that grows while the session is felt: what is older than a quarter of a second is in the file, which
// can be read whenever the writer ends, in whatever way. One thread.
class SessionWriter {
 public:
  static constexpr std::int64_t kPauseNs = 250'000'000;  // between two parts

  // A new file; fails if there is one of that name, or if it cannot be written. The session's head alone counts.
  static core::Result<SessionWriter> create(const RecordedSession& session, const std::string& path);

  SessionWriter(SessionWriter&&) noexcept;
  SessionWriter& operator=(SessionWriter&&) noexcept;
  ~SessionWriter();  // the file ends where it is

  // Appends the part of the session since the last call.
  core::Result<void> add(const RecordedSession& part);

  // Nothing follows: the file is whole.
  core::Result<void> finish();

  const std::string& path() const { return path_; }

 private:
  SessionWriter(std::string path, core::FileDescriptor file);
  core::Result<void> write();

  std::string path_;
  core::FileDescriptor file_;
  std::unique_ptr<SessionEncoder> encoder_;
};

}  // namespace afm::servo
