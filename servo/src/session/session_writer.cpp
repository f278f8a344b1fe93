// SPDX-License-Identifier: Apache-2.0
#include "servo/session_writer.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <cerrno>
#include <utility>

#include "core/system_error.h"
#include "core/write_all.h"
#include "session_chunks.h"

namespace afm::servo {

namespace {

constexpr mode_t kSessionMode = 0666;  // file mode, minus the user's umask

core::Result<void> cannot_write(const std::string& path, int error) {
  return core::failure(core::ErrorCategory::Failed,
                       fmt::format("cannot write {}: {}", path, core::system_error(error)));
}

}  // namespace

core::Result<SessionWriter> SessionWriter::create(const RecordedSession& session, const std::string& path) {
  core::FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kSessionMode));
  if (!file.is_open()) return tl::unexpected(cannot_write(path, errno).error());
  SessionWriter writer(path, std::move(file));
  writer.encoder_->head(session);
  if (auto written = writer.write(); !written) return tl::unexpected(written.error());
  return writer;
}

SessionWriter::SessionWriter(std::string path, core::FileDescriptor file)
    : path_(std::move(path)), file_(std::move(file)), encoder_(std::make_unique<SessionEncoder>()) {}
SessionWriter::SessionWriter(SessionWriter&&) noexcept = default;
SessionWriter& SessionWriter::operator=(SessionWriter&&) noexcept = default;
SessionWriter::~SessionWriter() = default;

core::Result<void> SessionWriter::add(const RecordedSession& part) {
  encoder_->part(part);
  return write();
}

core::Result<void> SessionWriter::finish() {
  encoder_->end();
  if (auto written = write(); !written) return written;
  if (::fsync(file_.get()) != 0) return cannot_write(path_, errno);
  return {};
}

core::Result<void> SessionWriter::write() {
  if (const int error = core::write_all(file_.get(), encoder_->bytes()); error != 0) return cannot_write(path_, error);
  encoder_->clear();
  return {};
}

}  // namespace afm::servo
