// SPDX-License-Identifier: Apache-2.0
#include "core/whole_file.h"

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <system_error>
#include <thread>

#include "core/file_descriptor.h"
#include "core/interruption.h"
#include "core/system_error.h"
#include "core/write_all.h"

namespace afm::core {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestFileBytes = std::uintmax_t{1} << 30U;
constexpr std::size_t kReadAtOnce = std::size_t{1} << 16U;
constexpr int kMostLinks = 40;  // one after the other, as Linux follows
constexpr mode_t kNewFileMode = 0666;
constexpr mode_t kPermissions = 07777;
constexpr auto kReaderPatience = std::chrono::seconds(5);
constexpr auto kReaderPause = std::chrono::milliseconds(20);

// Devices, pipes and what a process already has open: written into, never replaced. 0, or errno.
int write_into(const std::string& path, std::string_view bytes) {
  const auto end = std::chrono::steady_clock::now() + kReaderPatience;
  FileDescriptor file;
  // a pipe without a reader refuses instead of waiting
  while (!(file = FileDescriptor(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK))).is_open()) {
    if (errno != ENXIO || std::chrono::steady_clock::now() > end) return errno;
    std::this_thread::sleep_for(kReaderPause);
  }
  if (::fcntl(file.get(), F_SETFL, 0) != 0) return errno;
  return write_all(file.get(), bytes);
}

// Beside `path`, under a name that nobody can guess and hold ready as a link. 0, or errno.
int replace(const fs::path& path, std::string_view bytes, std::optional<mode_t> permissions) {
  std::uint64_t random = 0;
  if (::getrandom(&random, sizeof(random), 0) != sizeof(random)) return errno;
  const std::string part = (path.parent_path() / (".touchafm-" + std::to_string(random) + ".part")).string();
  const OnInterruption undo([part] { ::unlink(part.c_str()); });  // before there is a file: it may find no memory
  FileDescriptor file(::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kNewFileMode));
  if (!file.is_open()) return errno;
  int error = write_all(file.get(), bytes);
  if (error == 0 && permissions && ::fchmod(file.get(), *permissions) != 0) error = errno;
  if (error == 0 && ::fsync(file.get()) != 0) error = errno;
  if (error == 0 && ::rename(part.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) ::unlink(part.c_str());
  return error;
}

// What `path` is after all links; `path` itself where a link ends in another process's or our own open files.
std::optional<fs::path> follow_links(const std::string& path) {
  fs::path target = path;
  for (int links = 0; links < kMostLinks; ++links) {
    std::error_code error;
    const fs::path next = fs::read_symlink(target, error);
    if (error) return target;
    target = target.parent_path() / next;  // next alone, if it begins at the root
    if (target.string().starts_with("/proc/")) return std::nullopt;
  }
  return target;
}

int write_file_or_errno(const std::string& path, std::string_view bytes) {
  struct stat now{};
  const bool exists = ::stat(path.c_str(), &now) == 0;
  if (!exists && errno != ENOENT) return errno;
  if (exists && S_ISDIR(now.st_mode)) return EISDIR;
  const auto target = follow_links(path);
  if (!target || (exists && !S_ISREG(now.st_mode))) return write_into(path, bytes);
  if (exists && ::access(path.c_str(), W_OK) != 0) return errno;  // a rename would not ask
  return replace(*target, bytes, exists ? std::optional(now.st_mode & kPermissions) : std::nullopt);
}

}  // namespace

Result<std::string> read_file(const std::string& path) {
  const auto bad = [&](const std::string& why) {
    return core::failure(core::ErrorCategory::BadInputFile, "cannot read " + path + ": " + why);
  };
  // what is no file is not waited for
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK));
  if (!file.is_open()) return bad(errno == ENOENT ? "there is no such file" : system_error(errno));
  struct stat now{};
  if (::fstat(file.get(), &now) != 0) return bad(system_error(errno));
  if (!S_ISREG(now.st_mode)) return bad(S_ISDIR(now.st_mode) ? "it is a folder" : "it is not a regular file");
  std::string bytes;
  for (;;) {
    const std::size_t before = bytes.size();
    bytes.resize(before + kReadAtOnce);
    const ssize_t got = ::read(file.get(), bytes.data() + before, kReadAtOnce);
    bytes.resize(before + static_cast<std::size_t>(got > 0 ? got : 0));
    if (got == 0) return bytes;
    if (got < 0 && errno != EINTR) return bad(system_error(errno));
    if (bytes.size() > kLargestFileBytes) return bad("it is larger than 1 GiB");
  }
}

Result<void> write_file(const std::string& path, std::string_view bytes) {
  const int error = write_file_or_errno(path, bytes);
  if (error == 0) return {};
  return core::failure(
      core::ErrorCategory::Failed,
      "cannot write " + path + ": " + (error == ENXIO ? "no program reads from it" : system_error(error)));
}

}  // namespace afm::core
