// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/result.h"

namespace afm::exhibit {

// A speech program, started for each phrase: espeak-ng, which is GPL and therefore never linked, writes the voice to a
// pipe; spd-say passes the text to the voice of a screen reader.
struct SpeechProgram {
  enum class Voice { Piped, ItsOwn };

  std::string path;      // path of the executable
  std::string language;  // language of the voice, such as "en"
  Voice voice = Voice::Piped;

  // Command-line arguments with the text as the last one, protected from being parsed as an option.
  std::vector<std::string> arguments(const std::string& text) const;
};

// One run of the program, in a separate process group, without input and with its stderr discarded. Ends with the
// object, by force if necessary. One thread, except for stop().
class SpeechChild {
 public:
  // Longest time for writing a whole phrase to a pipe, and for speaking it.
  static constexpr std::int64_t kPipedMs = 2'000, kItsOwnMs = 30'000;
  static constexpr std::size_t kMostBytes = 16'000'000;  // size of three minutes of a voice

  // Runs the program and returns its output. Calls `cut_off` every few milliseconds and ends the child, with an empty
  // result, once it returns true. Failed, with one line of text, if it cannot be started, takes too long, ends with an
  // error, or writes too much.
  core::Result<std::string> run(const SpeechProgram& program, const std::string& text,
                                const std::function<bool()>& cut_off);

  // Kills the running child, if any. Any thread, including that of an interruption.
  void stop() noexcept;

 private:
  core::Result<std::string> collect(int pipe, const std::string& path, std::int64_t limit_ms,
                                    const std::function<bool()>& cut_off);
  void end(int grace_ms, int& status) noexcept;

  std::atomic<pid_t> child_{0};
};

}  // namespace afm::exhibit
