// SPDX-License-Identifier: Apache-2.0
#include "exhibit/sound/speaker.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/log.h"
#include "exhibit/sound/stream_clock.h"
#include "exhibit/sound/wav_file.h"

namespace afm::exhibit {

namespace {

constexpr std::chrono::milliseconds kFullRingPause(20);
constexpr std::chrono::nanoseconds kLongWait = std::chrono::hours(1);

}  // namespace

Speaker::Speaker(SpeechProgram program, SoundMixer& mixer, const core::Clock& clock)
    : program_(std::move(program)), mixer_(mixer), clock_(clock), ended_([this] { child_.stop(); }), thread_([this] {
        run();
      }) {}

Speaker::~Speaker() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  child_.stop();
  wake_.notify_one();
  thread_.join();
}

void Speaker::offer(SpeechText text) {
  {
    const std::lock_guard lock(mutex_);
    queue_.offer(std::move(text));
    // the new text interrupts the current one
    if (queue_.next_ns() == 0) newer_ = true;
  }
  wake_.notify_one();
}

void Speaker::run() {
  std::unique_lock lock(mutex_);
  while (!ending_) {
    auto text = queue_.take(clock_.now_ns());
    if (!text) {
      const auto next_ns = queue_.next_ns();
      const std::chrono::nanoseconds wait(next_ns ? *next_ns - clock_.now_ns() : kLongWait.count());
      wake_.wait_for(lock, std::min(wait, kLongWait));
      continue;
    }
    newer_ = false;
    lock.unlock();
    speak(*text);
    lock.lock();
  }
}

void Speaker::speak(const SpeechText& text) {
  mixer_.cut_voice(++phrase_);
  const auto bytes = child_.run(program_, text.text, [this] { return cut_off(); });
  if (!bytes) log_once(bytes.error().message);
  if (bytes && program_.voice == SpeechProgram::Voice::Piped && !cut_off()) return play(*bytes);
  spoken_until(clock_.now_ns());
}

void Speaker::play(const std::string& wav) {
  const auto voice = parse_mono_wav(wav);
  if (!voice) log_once("speech: " + program_.path + " wrote no sound; captions go on");
  const std::vector<float> samples = voice ? resampled(*voice, kSoundRateHz) : std::vector<float>();
  const std::int64_t length_ns = static_cast<std::int64_t>(samples.size()) * 1'000'000'000 / kSoundRateHz;
  const std::int64_t end_ns = clock_.now_ns() + length_ns;
  spoken_until(end_ns);
  for (std::size_t at = 0; at < samples.size();) {
    VoiceBlock block{.phrase = phrase_};
    block.count = static_cast<std::uint32_t>(std::min(VoiceBlock::kSamples, samples.size() - at));
    std::copy_n(samples.begin() + static_cast<std::ptrdiff_t>(at), block.count, block.samples.begin());
    // full for longer than the phrase: nobody reads
    while (!mixer_.speak(block)) {
      if (cut_off() || clock_.now_ns() > end_ns) return;
      std::this_thread::sleep_for(kFullRingPause);
    }
    at += block.count;
  }
}

void Speaker::spoken_until(std::int64_t end_ns) {
  const std::lock_guard lock(mutex_);
  queue_.spoken_until(end_ns);
}

void Speaker::log_once(const std::string& line) {
  if (!std::exchange(logged_, true)) core::log_line(line);
}

}  // namespace afm::exhibit
