// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/view/sound_settings.h"
#include "core/clock.h"
#include "exhibit/sound/narrator.h"

namespace afm::curves {
struct SampleModel;
}
namespace afm::exhibit {
class SoundMixer;
class SoundOutput;
class Speaker;
}  // namespace afm::exhibit
namespace afm::servo {
class ServoClient;
}

namespace afm::app {

// What is heard at the live window. A card that is missing or gets lost costs one line of the log. Main thread; the
// threads of SDL, of the voice and of the servo's listener are behind it.
class LiveSound {
 public:
  // Phrases and clock must outlive it.
  LiveSound(const LiveSoundSettings& settings, const exhibit::Phrases& phrases, std::vector<std::string> titles,
            const core::Clock& clock);
  ~LiveSound();

  // A servo that has been started: its tip is heard from now on, with these ears.
  void attach(servo::ServoClient& servo, const std::vector<curves::SampleModel>& materials);
  void set_ear(std::size_t material, const curves::SampleModel& model);

  exhibit::Narrator& narrator() { return narrator_; }

  // Once a frame: whether the card is still there.
  void check_card();
  bool lacks_card() const { return settings_.sound && !output_; }

  // Whether tones and signals are heard, where --sound asks for them; speech always is.
  void set_tones(bool heard);

  // Silent, or as before.
  void toggle();
  void unmute();

  // The key Y: speaks even without --speech, where there is a program that can.
  void say_state(const scene::TipState& tip);

 private:
  void open_card();
  void open_voice(const exhibit::SpeechProgram& program);
  void say(const exhibit::SpeechText& text);
  void set_volume();

  LiveSoundSettings settings_;
  const exhibit::Phrases& phrases_;
  const core::Clock& clock_;
  std::unique_ptr<exhibit::SoundMixer> mixer_;  // large
  exhibit::Narrator narrator_;
  std::unique_ptr<exhibit::SoundOutput> output_;
  std::unique_ptr<exhibit::Speaker> speaker_;
  bool muted_ = false;
  bool looked_for_voice_ = false;
  bool asked_ = false;  // by the key Y, which is answered at this moment
};

}  // namespace afm::app
