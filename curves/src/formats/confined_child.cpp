// SPDX-License-Identifier: Apache-2.0
#include "formats/confined_child.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "core/file_descriptor.h"
#include "core/system_error.h"
#include "curves/curve_error.h"

namespace afm::curves {

namespace {

constexpr rlim_t kMoreMemory = rlim_t{512} << 20U;
constexpr rlim_t kMoreSeconds = 3;

void confine() {
  // in pages; the limit is relative, because a sanitizer maps terabytes to begin with
  rlim_t mapped = 0;
  std::ifstream("/proc/self/statm") >> mapped;
  const rlim_t memory = mapped * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + kMoreMemory;
  const rlimit address_space{memory, memory}, no_core{0, 0};
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const rlim_t seconds = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + kMoreSeconds;
  const rlimit processor{seconds, seconds};
  if (::setrlimit(RLIMIT_AS, &address_space) != 0 || ::setrlimit(RLIMIT_CPU, &processor) != 0 ||
      ::setrlimit(RLIMIT_CORE, &no_core) != 0) {
    throw std::runtime_error("cannot limit the reader of a file");
  }
}

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

std::string read_all(int descriptor) {
  std::string bytes;
  char buffer[65536];
  for (;;) {
    const ssize_t count = ::read(descriptor, buffer, sizeof(buffer));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return bytes;
    bytes.append(buffer, static_cast<std::size_t>(count));
  }
}

enum ChildExit : int { kDone = 0, kFault = 1, kFailed = 2 };

// Never returns: the parent's destructors and buffers are not the child's to run or flush.
[[noreturn]] void run_child(const std::function<std::string()>& work, int descriptor) {
  int code = kFailed;
  try {
    confine();
    code = write_all(descriptor, work()) ? kDone : kFailed;
  } catch (const CurveError& fault) {
    code = write_all(descriptor, fault.what()) ? kFault : kFailed;
  } catch (const std::exception&) {
    code = kFailed;
  }
  ::_exit(code);
}

}  // namespace

std::string in_confined_child(const std::function<std::string()>& work, const std::string& on_death) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw std::runtime_error(std::string("cannot make a pipe: ") + core::system_error(errno));
  core::FileDescriptor from_child(ends[0]), to_parent(ends[1]);
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error(std::string("cannot start a process: ") + core::system_error(errno));
  if (child == 0) run_child(work, to_parent.get());
  to_parent.close();
  std::string bytes = read_all(from_child.get());
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == kDone) return bytes;
  if (WIFEXITED(status) && WEXITSTATUS(status) == kFault) throw CurveError(bytes);
  throw CurveError(on_death);
}

}  // namespace afm::curves
