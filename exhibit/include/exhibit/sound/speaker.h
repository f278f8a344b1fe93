// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "core/clock.h"
#include "core/interruption.h"
#include "exhibit/sound/sound_mixer.h"
#include "exhibit/sound/speech_program.h"
#include "exhibit/sound/speech_queue.h"

namespace afm::exhibit {

// Speaks texts in a separate thread, in the order of a SpeechQueue. A failing program costs one line of the log,
// however often it fails. Call offer() from one thread; it never waits.
class Speaker {
 public:
  // `mixer` receives the voice of a program that writes to a pipe. Mixer and clock must outlive the object.
  Speaker(SpeechProgram program, SoundMixer& mixer, const core::Clock& clock);
  Speaker(const Speaker&) = delete;
  Speaker& operator=(const Speaker&) = delete;
  ~Speaker();

  void offer(SpeechText text);

 private:
  void run();
  void speak(const SpeechText& text);
  void play(const std::string& wav);
  void spoken_until(std::int64_t end_ns);
  bool cut_off() const { return newer_.load() || ending_.load(); }
  void log_once(const std::string& line);

  SpeechProgram program_;
  SoundMixer& mixer_;
  const core::Clock& clock_;
  SpeechChild child_;
  core::OnInterruption ended_;
  std::mutex mutex_;  // protects queue_
  std::condition_variable wake_;
  SpeechQueue queue_;
  std::atomic<bool> newer_{false};  // true: newer text, which interrupts the current phrase
  std::atomic<bool> ending_{false};
  std::uint32_t phrase_ = 0;
  bool logged_ = false;
  std::thread thread_;  // last, because it uses all other members
};

}  // namespace afm::exhibit
