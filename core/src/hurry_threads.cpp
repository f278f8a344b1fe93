// SPDX-License-Identifier: Apache-2.0
#include "core/hurry_threads.h"

#include <sys/resource.h>
#include <unistd.h>

#include <charconv>
#include <filesystem>
#include <string>
#include <system_error>

namespace afm::core {

void hurry_threads() {
  const int own = ::getpriority(PRIO_PROCESS, static_cast<id_t>(::getpid()));
  std::error_code gone;
  std::filesystem::directory_iterator task("/proc/self/task", gone);
  for (; !gone && task != std::filesystem::directory_iterator(); task.increment(gone)) {
    const std::string name = task->path().filename().string();
    id_t thread = 0;
    std::from_chars(name.data(), name.data() + name.size(), thread);
    if (thread != 0 && ::getpriority(PRIO_PROCESS, thread) > own) ::setpriority(PRIO_PROCESS, thread, own);
  }
}

}  // namespace afm::core
