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
#include <utility>

#include "core/file_descriptor.h"
#include "core/interruption.h"
#include "core/log.h"
#include "core/new_file.h"
#include "core/system_error.h"
#include "core/write_all.h"
#include "move_to_new.h"

namespace afm::core {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestFileBytes = std::uintmax_t{1} << 30U;
constexpr std::size_t kReadAtOnce = std::size_t{1} << 16U;
constexpr int kMostLinks = 40;  // limit of a chain of links, as in Linux
constexpr mode_t kNewFileMode = 0666;
constexpr mode_t kPermissions = 07777;
constexpr auto kReaderPatience = std::chrono::seconds(5);
constexpr auto kReaderPause = std::chrono::milliseconds(20);

// Name of a file type other than a regular file, such as "a folder".
const char* kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  return S_ISSOCK(mode) ? "a socket" : "a device";
}

// Writes directly into devices, pipes and files already open in a process, which must not be replaced. Returns 0 or
// errno.
int write_into(const std::string& path, std::string_view bytes) {
  const auto end = std::chrono::steady_clock::now() + kReaderPatience;
  bool is_said = false;
  FileDescriptor file;
  // opening a pipe without a reader fails instead of blocking
  while (!(file = FileDescriptor(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK))).is_open()) {
    if (errno != ENXIO || std::chrono::steady_clock::now() > end) return errno;
    if (!std::exchange(is_said, true))
      log_line(path + " is a pipe: waiting up to 5 s for a program that reads from it");
    std::this_thread::sleep_for(kReaderPause);
  }
  if (::fcntl(file.get(), F_SETFL, 0) != 0) return errno;
  return write_all(file.get(), bytes);
}

using Move = int (*)(const std::string& from, const std::string& to);  // returns 0 or errno

int move_over(const std::string& from, const std::string& to) {
  return ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

// Writes a temporary file next to `path` and moves it there. Its random name cannot be guessed and prepared as a link.
// Returns 0 or errno.
int put_in_place(const fs::path& path, std::string_view bytes, std::optional<mode_t> permissions, Move move) {
  std::uint64_t random = 0;
  if (::getrandom(&random, sizeof(random), 0) != sizeof(random)) return errno;
  const std::string part = (path.parent_path() / (".touchafm-" + std::to_string(random) + ".part")).string();
  const OnInterruption undo([part] { ::unlink(part.c_str()); });  // precedes the file, as memory may run out
  FileDescriptor file(::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kNewFileMode));
  if (!file.is_open()) return errno;
  int error = write_all(file.get(), bytes);
  if (error == 0 && permissions && ::fchmod(file.get(), *permissions) != 0) error = errno;
  if (error == 0 && ::fsync(file.get()) != 0) error = errno;
  if (error == 0) error = move(part, path.string());
  if (error != 0) ::unlink(part.c_str());
  return error;
}

// Target of `path` after all links; nothing if a link ends in the open files of a process (/proc).
std::optional<fs::path> follow_links(const std::string& path) {
  fs::path target = path;
  for (int links = 0; links < kMostLinks; ++links) {
    std::error_code error;
    const fs::path next = fs::read_symlink(target, error);
    if (error) return target;
    target = target.parent_path() / next;  // only `next` if it is absolute
    if (target.string().starts_with("/proc/")) return std::nullopt;
  }
  return target;
}

// Type and permissions of the file at `path`; nothing if it does not exist. Returns errno on failure, and for a folder.
tl::expected<std::optional<mode_t>, int> mode_of_target(const std::string& path) {
  struct stat now{};
  if (::stat(path.c_str(), &now) == 0) {
    if (S_ISDIR(now.st_mode)) return tl::unexpected(EISDIR);
    return std::optional(now.st_mode);
  }
  if (errno != ENOENT) return tl::unexpected(errno);
  return std::nullopt;
}

tl::unexpected<Error> unwritable(const std::string& path, int error) {
  std::string why = system_error(error);
  if (error == ENXIO) why = "no program reads from it";
  const fs::path folder = follow_links(path).value_or(path).parent_path();
  std::error_code ignored;
  if (error == ENOENT && folder.empty()) {
    if (fs::current_path(ignored).empty()) why = "the current folder has been deleted; go to another";
  } else if (error == ENOENT) {
    why = fs::exists(folder, ignored) ? "the folder " + folder.string() + " takes no new files; choose another"
                                      : "there is no folder " + folder.string() + "; make it, or choose another";
  }
  return failure(ErrorCategory::Failed, "cannot write " + path + ": " + why);
}

int write_file_or_errno(const std::string& path, std::string_view bytes, Move move) {
  const auto mode = mode_of_target(path);
  if (!mode) return mode.error();
  const auto target = follow_links(path);
  if (!target || (*mode && !S_ISREG(**mode))) return write_into(path, bytes);
  if (*mode && ::access(path.c_str(), W_OK) != 0) return errno;  // permission that a rename would not check
  return put_in_place(*target, bytes, *mode ? std::optional(**mode & kPermissions) : std::nullopt, move);
}

// Reads the whole file, or slightly more than `most` bytes of it.
Result<std::string> read_up_to(const std::string& path, std::uintmax_t most) {
  const auto bad = [&](const std::string& why) {
    return core::failure(core::ErrorCategory::BadInputFile, "cannot read " + path + ": " + why);
  };
  // pipes and devices must not block
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK));
  if (!file.is_open()) return bad(errno == ENOENT ? "there is no such file" : system_error(errno));
  struct stat now{};
  if (::fstat(file.get(), &now) != 0) return bad(system_error(errno));
  if (!S_ISREG(now.st_mode)) return bad(std::string("it is ") + kind_of(now.st_mode) + ", not a file");
  std::string bytes;
  for (;;) {
    const std::size_t before = bytes.size();
    bytes.resize(before + kReadAtOnce);
    const ssize_t got = ::read(file.get(), bytes.data() + before, kReadAtOnce);
    bytes.resize(before + static_cast<std::size_t>(got > 0 ? got : 0));
    if (got == 0) return bytes;
    if (got < 0 && errno != EINTR) return bad(system_error(errno));
    if (bytes.size() > most) return bytes;
  }
}

}  // namespace

Result<std::string> read_file(const std::string& path) {
  auto bytes = read_up_to(path, kLargestFileBytes);
  if (bytes && bytes->size() > kLargestFileBytes) {
    return failure(ErrorCategory::BadInputFile, "cannot read " + path + ": it is larger than 1 GiB");
  }
  return bytes;
}

Result<std::string> read_beginning(const std::string& path, std::size_t most) {
  auto bytes = read_up_to(path, most);
  if (bytes && bytes->size() > most) bytes->resize(most);
  return bytes;
}

Result<void> write_file(const std::string& path, std::string_view bytes) {
  const int error = write_file_or_errno(path, bytes, move_over);
  if (error == 0) return {};
  return unwritable(path, error);
}

Result<void> write_new_file(const std::string& path, std::string_view bytes) {
  const int error = write_file_or_errno(path, bytes, move_to_new);
  if (error == 0) return {};
  if (error != EEXIST) return unwritable(path, error);
  return failure(ErrorCategory::WrongUsage,
                 "there is already a file " + path + ", and no file is replaced; choose another name");
}

Result<void> check_writable(const std::string& path) {
  const auto mode = mode_of_target(path);
  if (!mode) return unwritable(path, mode.error());
  const auto target = follow_links(path);
  // a pipe's reader may open it later
  if (!target || (*mode && !S_ISREG(**mode))) return {};
  if (*mode && ::access(path.c_str(), W_OK) != 0) return unwritable(path, errno);
  const fs::path folder = target->has_parent_path() ? target->parent_path() : fs::path(".");
  if (::access(folder.c_str(), W_OK | X_OK) != 0) return unwritable(path, errno);
  return {};
}

std::string kind_of_no_file(const std::string& path) {
  struct stat now{};
  if (::stat(path.c_str(), &now) != 0 || S_ISREG(now.st_mode)) return {};
  return kind_of(now.st_mode);
}

}  // namespace afm::core
