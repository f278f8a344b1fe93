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

// Sound of the live window. A missing or lost sound card costs one line of the log. Main thread; uses threads of SDL,
// of the voice and of the servo's listener.
class LiveSound {
 public:
  // Phrases and clock must outlive the object.
  LiveSound(const LiveSoundSettings& settings, const exhibit::Phrases& phrases, std::vector<std::string> titles,
            const core::Clock& clock);
  ~LiveSound();

  // Makes the tip of a newly started servo audible, at these ears.
  void attach(servo::ServoClient& servo, const std::vector<curves::SampleModel>& materials);
  void set_ear(std::size_t material, const curves::SampleModel& model);

  exhibit::Narrator& narrator() { return narrator_; }

  // Checks that the sound card is still there. Call once a frame.
  void check_card();
  bool lacks_card() const { return settings_.sound && !output_; }

  // Enables tones and signals, if --sound was given. Speech is always audible.
  void set_tones(bool heard);

  // Mutes or unmutes.
  void toggle();
  void unmute();

  // Key Y: speaks even without --speech, if a speech program is installed.
  void say_state(const scene::TipState& tip);

 private:
  void open_card();
  void open_voice(const exhibit::SpeechProgram& program);
  void say(const exhibit::SpeechText& text);
  void set_volume();

  LiveSoundSettings settings_;
  const exhibit::Phrases& phrases_;
  const core::Clock& clock_;
  std::unique_ptr<exhibit::SoundMixer> mixer_;  // mixer of all sounds, too large for the stack
  exhibit::Narrator narrator_;
  std::unique_ptr<exhibit::SoundOutput> output_;
  std::unique_ptr<exhibit::Speaker> speaker_;
  bool muted_ = false;
  bool looked_for_voice_ = false;
  bool asked_ = false;  // true: key Y pressed, to be answered in the current frame
};

}  // namespace afm::app
