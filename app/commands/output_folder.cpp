// SPDX-License-Identifier: Apache-2.0
#include "app/commands/output_folder.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>
#include <utility>

#include "core/whole_file.h"

namespace afm::app {

namespace fs = std::filesystem;

core::Result<OutputFolder> OutputFolder::open(const std::string& path) {
  const auto failed = [&](const std::string& why) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot write the output folder {}: {}; choose another with --out", path, why));
  };
  std::error_code error;
  fs::create_directories(path, error);
  if (error) return failed(error.message());
  if (!fs::is_directory(path, error)) return failed("it is not a folder");

  // inside the folder, so that the moves of commit() stay on one file system; a killed run may have left one behind
  const std::string staging = path + "/.unfinished";
  fs::remove_all(staging, error);
  if (!error) fs::create_directory(staging, error);
  if (error) return failed(error.message());
  return OutputFolder(path, staging);
}

OutputFolder::OutputFolder(OutputFolder&& other) noexcept
    : path_(std::move(other.path_)), staging_(std::exchange(other.staging_, {})) {}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!staging_.empty()) fs::remove_all(staging_, ignored);
}

std::string OutputFolder::staged(std::string_view name) const { return staging_ + "/" + std::string(name); }

core::Result<void> OutputFolder::write(std::string_view name, std::string_view bytes) {
  return core::write_file(staged(name), bytes);
}

core::Result<void> OutputFolder::commit() {
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
