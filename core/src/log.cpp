// SPDX-License-Identifier: Apache-2.0
#include "core/log.h"

#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <deque>
#include <mutex>
#include <string>

#include "core/file_descriptor.h"
#include "core/printable.h"

namespace afm::core {

namespace {

constexpr std::size_t kMostWaitingLines = 256;
constexpr int kLookMs = 100;                   // time within which a replaced stderr, as by dup2, is noticed
constexpr std::size_t kWriterStack = 1 << 16;  // size of the writer's stack, whose pages the servo locks

// stderr, written to without waiting. O_NONBLOCK belongs to an open file, which other processes share: pipes and
// terminals are opened once more.
class Outlet {
 public:
  // Returns the number of bytes that were written or can never be. Fewer than all: the reader does not read.
  std::size_t write(std::string_view text) {
    struct stat status{};
    if (::fstat(STDERR_FILENO, &status) != 0) return text.size();
    ssize_t written = 0;
    if (S_ISSOCK(status.st_mode)) {
      written = ::send(STDERR_FILENO, text.data(), text.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    } else if (S_ISFIFO(status.st_mode) || S_ISCHR(status.st_mode)) {
      reopen(status);
      if (!own_.is_open() && !accepts()) return 0;
      written = ::write(own_.is_open() ? own_.get() : STDERR_FILENO, text.data(), text.size());
    } else {
      written = ::write(STDERR_FILENO, text.data(), text.size());
    }
    if (written >= 0) return static_cast<std::size_t>(written);
    return errno == EAGAIN || errno == EINTR ? 0 : text.size();
  }

  // Waits until the reader reads again, at most kLookMs.
  static void wait() {
    pollfd watched{.fd = STDERR_FILENO, .events = POLLOUT, .revents = 0};
    ::poll(&watched, 1, kLookMs);
  }

 private:
  void reopen(const struct stat& status) {
    if (status.st_dev == device_ && status.st_ino == inode_) return;
    device_ = status.st_dev;
    inode_ = status.st_ino;
    own_ = FileDescriptor(::open("/proc/self/fd/2", O_WRONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  }

  // True if stderr can be written; also where a confined process may not ask.
  static bool accepts() {
    pollfd watched{.fd = STDERR_FILENO, .events = POLLOUT, .revents = 0};
    return ::poll(&watched, 1, 0) != 0;
  }

  FileDescriptor own_;  // own open file for stderr; closed: not possible, as for another user's terminal
  dev_t device_ = 0;
  ino_t inode_ = 0;
};

struct Log {
  std::mutex mutex;  // guard of the members below
  Outlet outlet;
  std::deque<std::string> waiting;
  std::size_t dropped = 0;
  bool has_writer = false;

  // Returns true once nothing waits any more.
  bool drain() {
    while (!waiting.empty()) {
      std::string& line = waiting.front();
      const std::size_t written = outlet.write(line);
      line.erase(0, written);
      if (!line.empty()) return false;
      waiting.pop_front();
      if (waiting.empty() && dropped > 0) {
        waiting.push_back("touchafm: " + std::to_string(dropped) + " lines of the log were dropped: nobody read it\n");
        dropped = 0;
      }
    }
    return true;
  }
};

// Never destroyed: the writer may outlive main's statics.
Log& the_log() {
  static auto* const log = new Log;
  return *log;
}

void* write_waiting_lines(void*) {
  Log& log = the_log();
  for (;;) {
    Outlet::wait();
    const std::lock_guard lock(log.mutex);
    if (!log.drain()) continue;
    log.has_writer = false;
    return nullptr;
  }
}

// Starts the writer, not real-time; signals go to the other threads. False: no thread can be started.
bool start_writer() {
  sigset_t every, before;
  ::sigfillset(&every);
  pthread_attr_t attributes;
  if (::pthread_attr_init(&attributes) != 0) return false;
  const sched_param normal{};
  ::pthread_attr_setinheritsched(&attributes, PTHREAD_EXPLICIT_SCHED);
  ::pthread_attr_setschedpolicy(&attributes, SCHED_OTHER);
  ::pthread_attr_setschedparam(&attributes, &normal);
  ::pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
  ::pthread_attr_setstacksize(&attributes, kWriterStack);
  ::pthread_sigmask(SIG_SETMASK, &every, &before);
  pthread_t thread{};
  const bool started = ::pthread_create(&thread, &attributes, &write_waiting_lines, nullptr) == 0;
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  ::pthread_attr_destroy(&attributes);
  return started;
}

}  // namespace

void log_line(std::string_view text) {
  std::string line = "touchafm: ";
  line += printable_line(text);
  line += '\n';
  Log& log = the_log();
  const std::lock_guard lock(log.mutex);
  if (log.drain()) {
    line.erase(0, log.outlet.write(line));
    if (line.empty()) return;
  } else if (log.waiting.size() >= kMostWaitingLines) {
    ++log.dropped;
    return;
  }
  log.waiting.push_back(std::move(line));
  if (!log.has_writer) log.has_writer = start_writer();
}

}  // namespace afm::core
