// SPDX-License-Identifier: Apache-2.0
#include "app/options/output_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "core/system_error.h"
#include "core/whole_file.h"

namespace afm::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* kUnfinished = ".unfinished-";

// Locks the folder until the descriptor closes; empty if another process holds the lock.
std::optional<core::FileDescriptor> locked(const std::string& folder) {
  core::FileDescriptor file(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
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

core::Result<OutputFolder> OutputFolder::open(const std::string& path) {
  const auto failed = [&](const std::string& why) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot write to the output folder {}: {}; choose another with --out", path, why));
  };
  std::error_code error;
  fs::create_directories(path, error);
  if (error) return failed(error.message());
  if (!fs::is_directory(path, error)) return failed("it is not a folder");

  remove_abandoned(path);
  // inside the folder, so that commit() moves within one file system; with an unpredictable name, so that nobody can
  // prepare a link there
  std::string staging = path + "/" + kUnfinished + "XXXXXX";
  if (::mkdtemp(staging.data()) == nullptr) return failed(core::system_error(errno));
  auto lock = locked(staging);
  if (!lock) return failed("another program is using " + staging);
  return OutputFolder(path, staging, std::move(*lock));
}

OutputFolder::OutputFolder(std::string path, std::string staging, core::FileDescriptor lock)
    : path_(std::move(path)),
      staging_(std::move(staging)),
      lock_(std::move(lock)),
      undo_(std::make_unique<core::OnInterruption>([folder = staging_] {
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

core::Result<void> OutputFolder::write(std::string_view name, std::string_view bytes) {
  return core::write_file(staged(name), bytes);
}

core::Result<void> OutputFolder::commit() {
  const core::Uninterrupted all_or_none;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(staging_, error)) {
    fs::rename(entry.path(), fs::path(path_) / entry.path().filename(), error);
    if (error) break;
  }
  if (error) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot move the results into {}: {}", path_, error.message()));
  }
  return {};
}

}  // namespace afm::app
