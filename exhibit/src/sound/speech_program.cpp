// SPDX-License-Identifier: Apache-2.0
#include "exhibit/sound/speech_program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <optional>

#include "core/file_descriptor.h"
#include "core/system_error.h"

namespace afm::exhibit {

namespace {

constexpr int kPollMs = 5;
constexpr int kGraceMs = 100;  // time allowed after the program has closed its output
constexpr const char* kNowhere = "/dev/null";

core::Error speech_error(const std::string& path, const std::string& what) {
  return {core::ErrorCategory::Failed, fmt::format("speech: {} {}; captions go on", path, what)};
}

// Starts the program with the pipe as its output. Always frees the resources of posix_spawn.
class SpeechSpawn {
 public:
  SpeechSpawn() {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawnattr_init(&attributes_);
  }
  SpeechSpawn(const SpeechSpawn&) = delete;
  SpeechSpawn& operator=(const SpeechSpawn&) = delete;
  ~SpeechSpawn() {
    ::posix_spawn_file_actions_destroy(&actions_);
    ::posix_spawnattr_destroy(&attributes_);
  }

  // Returns 0 or the error number.
  int start(const std::string& path, std::vector<std::string>& arguments, int output, pid_t& child) {
    sigset_t none;
    ::sigemptyset(&none);
    for (const int error :
         {::posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, kNowhere, O_RDONLY, 0),
          ::posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO),
          ::posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, kNowhere, O_WRONLY, 0),
          ::posix_spawn_file_actions_addclosefrom_np(&actions_, STDERR_FILENO + 1),
          ::posix_spawnattr_setsigmask(&attributes_, &none), ::posix_spawnattr_setpgroup(&attributes_, 0),
          ::posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP)}) {
      if (error != 0) return error;
    }
    std::vector<char*> argv;
    argv.reserve(arguments.size() + 1);
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    return ::posix_spawn(&child, path.c_str(), &actions_, &attributes_, argv.data(), environ);
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

std::vector<std::string> SpeechProgram::arguments(const std::string& text) const {
  if (voice == Voice::ItsOwn) return {path, "--wait", "-l", language, "--", text};
  return {path, "--stdout", "-v", language, "--", text};
}

core::Result<std::string> SpeechChild::run(const SpeechProgram& program, const std::string& text,
                                           const std::function<bool()>& cut_off) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    return tl::unexpected(speech_error(program.path, fmt::format("got no pipe: {}", core::system_error(errno))));
  }
  const core::FileDescriptor from_child(ends[0]);
  core::FileDescriptor to_us(ends[1]);
  std::vector<std::string> arguments = program.arguments(text);
  pid_t child = -1;
  if (const int error = SpeechSpawn().start(program.path, arguments, to_us.get(), child); error != 0) {
    return tl::unexpected(speech_error(program.path, fmt::format("cannot be started: {}", core::system_error(error))));
  }
  to_us.close();
  child_ = child;
  const bool piped = program.voice == SpeechProgram::Voice::Piped;
  auto bytes = collect(from_child.get(), program.path, piped ? kPipedMs : kItsOwnMs, cut_off);
  int status = 0;
  end(cut_off() ? 0 : kGraceMs, status);
  const bool well = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (bytes && !well && !cut_off()) return tl::unexpected(speech_error(program.path, "ended with an error"));
  return bytes;
}

core::Result<std::string> SpeechChild::collect(int pipe, const std::string& path, std::int64_t limit_ms,
                                               const std::function<bool()>& cut_off) {
  using std::chrono::steady_clock;
  const auto end = steady_clock::now() + std::chrono::milliseconds(limit_ms);
  std::string bytes;
  std::array<char, 65536> buffer{};
  while (!cut_off()) {
    if (steady_clock::now() > end) {
      return tl::unexpected(
          speech_error(path, fmt::format("did not answer within {} s and was ended", limit_ms / 1000)));
    }
    pollfd waited{.fd = pipe, .events = POLLIN, .revents = 0};
    if (::poll(&waited, 1, kPollMs) <= 0) continue;
    const ssize_t count = ::read(pipe, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return bytes;
    bytes.append(buffer.data(), static_cast<std::size_t>(count));
    if (bytes.size() > kMostBytes) return tl::unexpected(speech_error(path, "does not stop speaking and was ended"));
  }
  return std::string();
}

// Ends a child that has closed its output or is no longer needed.
void SpeechChild::end(int grace_ms, int& status) noexcept {
  const pid_t child = child_.load();
  for (int waited = 0; ::waitpid(child, &status, WNOHANG) == 0; ++waited) {
    if (waited == grace_ms) ::kill(-child, SIGKILL);
    ::poll(nullptr, 0, 1);
  }
  child_ = 0;
}

void SpeechChild::stop() noexcept {
  if (const pid_t child = child_.load(); child > 0) ::kill(-child, SIGKILL);
}

}  // namespace afm::exhibit
