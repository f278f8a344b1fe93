// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/whole_file.h"
#include "support/scratch_folder.h"

namespace afm::support {

// A program that runs during the test, with its output on stderr. Ended at the latest with the thread that made it.
class LiveProgram {
 public:
  LiveProgram(std::vector<std::string> arguments, const std::string& display) {
    folder_.write("err", "");
    pid_ = ::fork();
    if (pid_ != 0) return;
    // no window left behind by a test that is killed, such as that of a mutant that hangs
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    ::setenv("DISPLAY", display.c_str(), 1);
    ::unsetenv("WAYLAND_DISPLAY");
    ::dup2(::open(err().c_str(), O_WRONLY | O_APPEND), STDERR_FILENO);
    std::vector<char*> raw;
    for (std::string& argument : arguments) raw.push_back(argument.data());
    raw.push_back(nullptr);
    ::execv(raw.front(), raw.data());
    ::_exit(127);
  }
  LiveProgram(const LiveProgram&) = delete;
  LiveProgram& operator=(const LiveProgram&) = delete;
  ~LiveProgram() {
    if (exit_code_) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }

  pid_t pid() const { return pid_; }
  std::string said() const { return core::read_file(err()).value(); }

  // Waits for `text` after the text of the last call; false after `patience`, or if the program has ended before.
  bool says(const std::string& text, std::chrono::seconds patience = std::chrono::minutes(1)) {
    return says_one_of({text}, patience) == text;
  }

  // Skips the output so far, so that later calls do not find it.
  void skip_what_it_said() { read_ = said().size(); }

  // Same for the first of several texts; returns it, or an empty text.
  std::string says_one_of(const std::vector<std::string>& texts,
                          std::chrono::seconds patience = std::chrono::minutes(1)) {
    std::string first;
    within(patience, [&] {
      const std::string all = said();
      std::size_t earliest = std::string::npos;
      for (const std::string& text : texts) {
        const std::size_t at = all.find(text, read_);
        if (at < earliest) {
          earliest = at;
          first = text;
        }
      }
      if (earliest != std::string::npos) read_ = earliest + first.size();
      return earliest != std::string::npos;
    });
    return first;
  }

  void signal(int number) const { ::kill(pid_, number); }

  bool has_ended() { return poll_end(); }

  // Exit code once it has ended; none after a minute.
  std::optional<int> ends() {
    within(std::chrono::minutes(1), [&] { return poll_end(); });
    return exit_code_;
  }

  // Waits for a condition; false after `patience`, or if it is still false when the program has ended.
  template <class Condition>
  bool within(std::chrono::seconds patience, Condition&& holds) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (!holds()) {
      if (poll_end() && holds()) return true;
      if (exit_code_ || std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return true;
  }

 private:
  bool poll_end() {
    int status = 0;
    if (!exit_code_ && ::waitpid(pid_, &status, WNOHANG) == pid_) {
      exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    return exit_code_.has_value();
  }
  std::string err() const { return folder_.file("err"); }

  ScratchFolder folder_;
  pid_t pid_ = -1;
  std::size_t read_ = 0;
  std::optional<int> exit_code_;
};

}  // namespace afm::support
