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

// A program that speaks, started once for each phrase: espeak-ng, which is GPL and therefore never linked, writes the
// voice to a pipe; spd-say hands the text to the voice of a screen reader.
struct SpeechProgram {
  enum class Voice { Piped, ItsOwn };

  std::string path;      // of the executable
  std::string language;  // "en"
  Voice voice = Voice::Piped;

  // With the text as its last argument, which is never taken for an option.
  std::vector<std::string> arguments(const std::string& text) const;
};

// A run of it in its own process group, with no input and no say on our stderr. Ended, by force if need be, when
// the run is over. One thread; only stop() may be called from any.
class SpeechChild {
 public:
  // Longer it may not take to give a whole phrase to a pipe, and to speak it itself.
  static constexpr std::int64_t kPipedMs = 2'000, kItsOwnMs = 30'000;
  static constexpr std::size_t kMostBytes = 16'000'000;  // three minutes of a voice

  // What it wrote. Asks `cut_off` every few milliseconds, and ends the child with nothing once that is true. Failed,
  // with one line, if it cannot be started, takes too long, ends with an error, or writes too much.
  core::Result<std::string> run(const SpeechProgram& program, const std::string& text,
                                const std::function<bool()>& cut_off);

  // Kills the child that runs, if one does. Any thread; an interruption's too.
  void stop() noexcept;

 private:
  core::Result<std::string> collect(int pipe, const std::string& path, std::int64_t limit_ms,
                                    const std::function<bool()>& cut_off);
  void end(int grace_ms, int& status) noexcept;

  std::atomic<pid_t> child_{0};
};

}  // namespace afm::exhibit
