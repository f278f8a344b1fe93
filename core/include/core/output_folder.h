// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/file_descriptor.h"
#include "core/interruption.h"
#include "core/result.h"

namespace afm::core {

// A results folder that appears completely or not at all: files are written into a temporary folder inside it, and
// commit() moves them into place. Without a commit nothing is left, even after a signal. One thread.
class OutputFolder {
 public:
  // Checks in advance, before hours of work, that `path` is writable.
  static Result<OutputFolder> open(const std::string& path);

  OutputFolder(OutputFolder&& other) noexcept;
  OutputFolder& operator=(OutputFolder&&) = delete;
  ~OutputFolder();

  // Path for writing a file of this name, valid until commit().
  std::string staged(std::string_view name) const;

  Result<void> write(std::string_view name, std::string_view bytes);

  // Moves every staged file into the folder. Replaces older files of the same names and keeps all others.
  Result<void> commit();

  // Commits without replacing any file: WrongUsage if a name exists. A failure moves back what was moved, so that all
  // files appear or none. The longest name appears first, so that FILE is never there without FILE.truth.json.
  Result<void> commit_new();

 private:
  OutputFolder(std::string path, std::string staging, FileDescriptor lock);

  std::string path_;
  std::string staging_;
  FileDescriptor lock_;  // lock of the staging folder while this process lives
  std::unique_ptr<OnInterruption> undo_;
};

}  // namespace afm::core
