// SPDX-License-Identifier: Apache-2.0
#include "private_folder.h"

#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

#include "core/system_error.h"

namespace afm::servo {

core::Result<std::filesystem::path> private_folder() {
  const char* runtime = ::secure_getenv("XDG_RUNTIME_DIR");
  std::filesystem::path folder = runtime != nullptr && *runtime == '/'
                                     ? std::filesystem::path(runtime) / "touchafm"
                                     : std::filesystem::path(fmt::format("/tmp/touchafm-{}", ::getuid()));
  if (::mkdir(folder.c_str(), S_IRWXU) != 0 && errno != EEXIST) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot create {}: {}", folder.string(), core::system_error(errno)));
  }
  struct stat found{};
  if (::lstat(folder.c_str(), &found) != 0 || !S_ISDIR(found.st_mode) || found.st_uid != ::getuid() ||
      (found.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("{} is not a private folder of this user: remove it", folder.string()));
  }
  return folder;
}

}  // namespace afm::servo
