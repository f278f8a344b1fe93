// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/clock.h"
#include "exhibit/sound/captions.h"
#include "exhibit/sound/speech_queue.h"
#include "exhibit/sound/tip_ear.h"
#include "exhibit/words/guidance.h"
#include "exhibit/words/phrases.h"
#include "servo/tip_listener.h"

namespace afm::exhibit {

// Turns events into captions, into the program's own signals, and into speech: everything that a person who cannot see
// the wall needs for the whole procedure. Thread of the frame loop.
class Narrator final : public servo::TipAudience {
 public:
  using Signal = std::function<void(const Heard&)>;    // receiver of events that do not come from a servo
  using Say = std::function<void(const SpeechText&)>;  // speech output that must not block

  // `titles` of the materials, in the language of the phrases. Phrases and clock must outlive the object.
  Narrator(const Phrases& phrases, std::vector<std::string> titles, const core::Clock& clock, Signal signal, Say say);

  // Every sample and event of the servo.
  void heard(const scene::TipSample& sample) override;
  void heard(const scene::TipEvent& event) override;

  // Any other event of the wall; `force_n` as in Heard.
  void happened(HeardEvent event, std::int32_t material, double force_n = 0.0);

  // Call once a frame, with the tip's state, the next step, and its line of guidance, which is spoken when it changes.
  struct Step {
    Hint hint = Hint::ChooseSample;
    std::string guidance;
    std::optional<std::uint32_t> scan_lines;  // number of finished lines of the current image; empty: no scan
  };
  void follow(const scene::TipState& tip, const Step& step);

  // Key Y: speaks the last event and the current state.
  void say_state(const scene::TipState& tip);

  // Extent of the reports on the tip. Everything; Force: only events that concern the force, because names and figures
  // would reveal an answer; Faults: only faults, so that nothing interrupts a question.
  enum class Telling { All, Force, Faults };
  void set_telling(Telling telling) { telling_ = telling; }

  // Reports a key's effect as a caption and as speech.
  void note(const std::string& text);

  const std::string& caption() { return captions_.text(clock_.now_ns()); }

 private:
  void tell(const Heard& heard);
  void follow_scan(std::uint32_t lines, std::int32_t material);
  std::string title(std::int32_t material) const;

  const Phrases& phrases_;
  std::vector<std::string> titles_;
  const core::Clock& clock_;
  Signal signal_;
  Say say_;
  TipEar ear_;
  Captions captions_;
  std::string guidance_;
  std::optional<Heard> last_;
  std::int32_t material_ = -1;
  Hint hint_ = Hint::ChooseSample;
  std::uint32_t scan_lines_ = 0;
  bool servo_silent_ = false;
  Telling telling_ = Telling::All;
};

}  // namespace afm::exhibit
