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

// Turns what happens into captions, into signals of the program itself, and into texts to speak: what a person who does
// not see the wall needs for the whole procedure. The frame loop's thread.
class Narrator final : public servo::TipAudience {
 public:
  using Signal = std::function<void(const Heard&)>;    // of what no servo reports
  using Say = std::function<void(const SpeechText&)>;  // must not block

  // `titles`: of the materials, in the language of the phrases, which must outlive this as the clock must.
  Narrator(const Phrases& phrases, std::vector<std::string> titles, const core::Clock& clock, Signal signal, Say say);

  // Every sample and event of the servo.
  void heard(const scene::TipSample& sample) override;
  void heard(const scene::TipEvent& event) override;

  // Once a frame: the state of the tip, the step that comes next, and its line of guidance, which is spoken when it is
  // another one.
  struct Step {
    Hint hint = Hint::ChooseSample;
    std::string guidance;
    std::optional<std::uint32_t> scan_lines;  // that an image has; none is taken
  };
  void follow(const scene::TipState& tip, const Step& step);

  // The key Y: the last event, and how things are.
  void say_state(const scene::TipState& tip);

  // What is told of the tip: everything; where names and figures would give an answer away, what concerns the force;
  // and while a question waits for its answer, faults alone, so that nothing cuts it off.
  enum class Telling { All, Force, Faults };
  void set_telling(Telling telling) { telling_ = telling; }

  // What a key did, in words that go on the wall and are spoken.
  void note(const std::string& text);

  const std::string& caption() { return captions_.text(clock_.now_ns()); }

 private:
  void tell(const Heard& heard);
  void happened(HeardEvent event, std::int32_t material);
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
