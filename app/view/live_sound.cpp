// SPDX-License-Identifier: Apache-2.0
#include "app/view/live_sound.h"

#include <utility>

#include "app/view/speech_choice.h"
#include "core/log.h"
#include "curves/sample_model.h"
#include "exhibit/sound/sound_mixer.h"
#include "exhibit/sound/sound_output.h"
#include "exhibit/sound/speaker.h"
#include "servo/servo_client.h"

namespace afm::app {

LiveSound::LiveSound(const LiveSoundSettings& settings, const exhibit::Phrases& phrases,
                     std::vector<std::string> titles, const core::Clock& clock)
    : settings_(settings),
      phrases_(phrases),
      clock_(clock),
      mixer_(std::make_unique<exhibit::SoundMixer>(settings.options.channels())),
      narrator_(
          phrases, std::move(titles), clock, [this](const exhibit::Heard& heard) { mixer_->happened(heard); },
          [this](const exhibit::SpeechText& text) { say(text); }) {
  mixer_->set_tones(settings_.sound);
  set_volume();
  if (settings_.sound) open_card();
  if (settings_.speech) open_voice(*settings_.speech);
}

LiveSound::~LiveSound() = default;

void LiveSound::open_card() {
  if (output_) return;
  auto output = exhibit::SoundOutput::open(*mixer_, clock_);
  if (!output) return core::log_line(output.error().message);
  output_ = std::move(*output);
  core::log_line("sound: " + output_->driver());
}

void LiveSound::open_voice(const exhibit::SpeechProgram& program) {
  looked_for_voice_ = true;
  if (program.voice == exhibit::SpeechProgram::Voice::Piped) open_card();
  speaker_ = std::make_unique<exhibit::Speaker>(program, *mixer_, clock_);
  core::log_line("speech: " + program.path);
}

void LiveSound::attach(servo::ServoClient& servo, const std::vector<curves::SampleModel>& materials) {
  for (std::size_t i = 0; i < materials.size(); ++i) set_ear(i, materials[i]);
  if (settings_.sound && output_) servo.listen(*mixer_);
}

void LiveSound::set_ear(std::size_t material, const curves::SampleModel& model) {
  if (output_) mixer_->set_ear(material, exhibit::Ear(*model.tables, model.parameters.free_amplitude_m));
}

void LiveSound::check_card() {
  if (!output_ || output_->plays()) return;
  core::log_line("no sound: the sound card is gone; connect it and start again, captions go on");
  output_.reset();
}

void LiveSound::set_volume() { mixer_->set_volume(muted_ ? 0.0 : settings_.options.gain()); }

void LiveSound::set_tones(bool heard) { mixer_->set_tones(heard && settings_.sound); }

void LiveSound::toggle() {
  muted_ = !muted_;
  set_volume();
  core::log_line(muted_ ? "sound off" : "sound on");
  narrator_.note(phrases_[muted_ ? exhibit::Phrase::SoundOff : exhibit::Phrase::SoundOn]);
}

void LiveSound::unmute() {
  muted_ = false;
  set_volume();
}

void LiveSound::say_state(const scene::TipState& tip) {
  if (!speaker_ && !std::exchange(looked_for_voice_, true)) {
    const auto program = choose_speech_program(phrases_[exhibit::Phrase::Language]);
    if (program) {
      open_voice(*program);
    } else {
      core::log_line(program.error().message);
    }
  }
  asked_ = true;
  narrator_.say_state(tip);
  asked_ = false;
}

// Without --speech, only the key Y speaks.
void LiveSound::say(const exhibit::SpeechText& text) {
  if (!settings_.speech && !asked_) return;
  core::log_line("says: " + text.text);
  if (speaker_) speaker_->offer(text);
}

}  // namespace afm::app
