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

// Session file that grows during the session. It contains everything older than a quarter of a second, and stays
// readable if the writer is interrupted at any point. One thread.
class SessionWriter {
 public:
  static constexpr std::int64_t kPauseNs = 250'000'000;  // interval between two parts

  // Creates a file; fails if one of that name exists, or if it is not writable. Uses only the session's header.
  static core::Result<SessionWriter> create(const RecordedSession& session, const std::string& path);

  SessionWriter(SessionWriter&&) noexcept;
  SessionWriter& operator=(SessionWriter&&) noexcept;
  ~SessionWriter();  // leaves an unfinished file as it is

  // Appends `part`, the data since the last call.
  core::Result<void> add(const RecordedSession& part);

  // Completes the file; nothing may be added afterwards.
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
