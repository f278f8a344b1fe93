// SPDX-License-Identifier: Apache-2.0
#include "core/output_folder.h"

#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <optional>
#include <system_error>
#include <utility>

#include "core/system_error.h"
#include "core/whole_file.h"
#include "move_to_new.h"

namespace afm::core {

namespace fs = std::filesystem;

namespace {

constexpr const char* kUnfinished = ".unfinished-";

// Locks the folder until the descriptor closes; empty if another process holds the lock.
std::optional<FileDescriptor> locked(const std::string& folder) {
  FileDescriptor file(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  if (!file.is_open() || ::flock(file.get(), LOCK_EX | LOCK_NB) != 0) return std::nullopt;
  return file;
}

// Removes staging folders that killed runs have left in the folder.
void remove_abandoned(const std::string& path) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, ignored)) {
    if (!entry.path().filename().string().starts_with(kUnfinished)) continue;
    if (locked(entry.path().string())) fs::remove_all(entry.path(), ignored);
  }
}

}  // namespace

Result<OutputFolder> OutputFolder::open(const std::string& path) {
  const auto failed = [&](const std::string& why) {
    return failure(ErrorCategory::Failed,
                   "cannot write to the output folder " + path + ": " + why + "; choose another with --out");
  };
  std::error_code error;
  fs::create_directories(path, error);
  if (error) return failed(error.message());
  if (!fs::is_directory(path, error)) return failed("it is not a folder");

  remove_abandoned(path);
  // inside the folder, so that commit() moves within one file system; with an unpredictable name, so that nobody can
  // prepare a link there
  std::string staging = path + "/" + kUnfinished + "XXXXXX";
  const Uninterrupted until_it_is_registered;
  if (::mkdtemp(staging.data()) == nullptr) return failed(system_error(errno));
  auto lock = locked(staging);
  if (!lock) return failed("another program is using " + staging);
  return OutputFolder(path, staging, std::move(*lock));
}

OutputFolder::OutputFolder(std::string path, std::string staging, FileDescriptor lock)
    : path_(std::move(path)),
      staging_(std::move(staging)),
      lock_(std::move(lock)),
      undo_(std::make_unique<OnInterruption>([folder = staging_] {
        std::error_code ignored;
        fs::remove_all(folder, ignored);
      })) {}

OutputFolder::OutputFolder(OutputFolder&& other) noexcept
    : path_(std::move(other.path_)),
      staging_(std::exchange(other.staging_, {})),
      lock_(std::move(other.lock_)),
      undo_(std::move(other.undo_)) {}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!staging_.empty()) fs::remove_all(staging_, ignored);
}

std::string OutputFolder::staged(std::string_view name) const { return staging_ + "/" + std::string(name); }

Result<void> OutputFolder::write(std::string_view name, std::string_view bytes) {
  auto written = write_file(staged(name), bytes);
  if (written) return written;
  Error error = written.error();
  // nobody knows the staging folder
  if (const std::size_t at = error.message.find(staging_); at != std::string::npos)
    error.message.replace(at, staging_.size(), path_);
  return tl::unexpected(error);
}

Result<void> OutputFolder::commit() {
  const Uninterrupted all_or_none;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(staging_, error)) {
    fs::rename(entry.path(), fs::path(path_) / entry.path().filename(), error);
    if (error) break;
  }
  if (error) {
    return failure(ErrorCategory::Failed, "cannot move the results into " + path_ + ": " + error.message());
  }
  return {};
}

Result<void> OutputFolder::commit_new() {
  const Uninterrupted all_or_none;
  std::error_code error;
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(staging_, error)) {
    names.push_back(entry.path().filename().string());
  }
  // nothing can move two files at once: a longer name, such as FILE.truth.json, comes before FILE
  std::sort(names.begin(), names.end(), std::greater<>());
  int failed = error.value();
  std::size_t moved = 0;
  while (failed == 0 && moved < names.size()) {
    failed = move_to_new(staged(names[moved]), path_ + "/" + names[moved]);
    if (failed == 0) ++moved;
  }
  if (failed == 0) return {};
  for (std::size_t i = 0; i < moved; ++i) ::rename((path_ + "/" + names[i]).c_str(), staged(names[i]).c_str());
  if (failed == EEXIST) {
    return wrong_usage("cannot write " + path_ + "/" + names[moved] +
                       ": it exists already; remove it, or choose another with --out");
  }
  return failure(ErrorCategory::Failed, "cannot move the results into " + path_ + ": " + system_error(failed));
}

}  // namespace afm::core
