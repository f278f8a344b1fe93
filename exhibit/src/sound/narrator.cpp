// SPDX-License-Identifier: Apache-2.0
#include "exhibit/sound/narrator.h"

#include <utility>

#include "exhibit/sound/spoken_text.h"

namespace afm::exhibit {

namespace {

// True for events with no name or figure, only the state of the force.
bool concerns_force(HeardEvent event) {
  return event == HeardEvent::ForceOn || event == HeardEvent::ForceOff || event == HeardEvent::Fault ||
         event == HeardEvent::TurnOnReady;
}

bool is_told(HeardEvent event, Narrator::Telling telling) {
  if (telling == Narrator::Telling::Faults) return event == HeardEvent::Fault;
  return telling == Narrator::Telling::All || concerns_force(event);
}

bool is_ready(Hint hint) { return hint == Hint::TurnOn || hint == Hint::TurnOnAndHold; }

}  // namespace

Narrator::Narrator(const Phrases& phrases, std::vector<std::string> titles, const core::Clock& clock, Signal signal,
                   Say say)
    : phrases_(phrases), titles_(std::move(titles)), clock_(clock), signal_(std::move(signal)), say_(std::move(say)) {}

std::string Narrator::title(std::int32_t material) const {
  const auto index = static_cast<std::size_t>(material);
  return telling_ != Telling::All || material < 0 || index >= titles_.size() ? std::string() : titles_[index];
}

void Narrator::tell(const Heard& heard) {
  if (!is_told(heard.event, telling_)) return;
  last_ = heard;
  const std::string sample = title(heard.material);
  captions_.add(heard.event, caption_of(phrases_, heard, sample), clock_.now_ns());
  if (row_of(heard.event).spoken == Spoken::AtOnce) say_({said_of(phrases_, heard, sample), SpeechKind::Event});
}

void Narrator::heard(const scene::TipSample& sample) {
  if (const auto heard = ear_.add(sample)) tell(*heard);
}

void Narrator::heard(const scene::TipEvent& event) { tell(heard_of(event)); }

void Narrator::happened(HeardEvent event, std::int32_t material, double force_n) {
  const Heard heard{.event = event, .time_ns = clock_.now_ns(), .force_n = force_n, .material = material};
  if (is_told(event, telling_)) signal_(heard);
  tell(heard);
}

void Narrator::follow(const scene::TipState& tip, const Step& step) {
  if (std::exchange(material_, tip.material) != tip.material && tip.material >= 0) {
    happened(HeardEvent::SampleChosen, tip.material);
  }
  if (is_ready(step.hint) && !is_ready(std::exchange(hint_, step.hint))) {
    happened(HeardEvent::TurnOnReady, tip.material);
  }
  hint_ = step.hint;
  // without samples from the servo
  const bool silent = step.hint == Hint::ServoEnded || tip.fault == scene::FaultCode::ServoSilent;
  if (silent && !std::exchange(servo_silent_, silent)) happened(HeardEvent::Fault, tip.material);
  servo_silent_ = silent;
  follow_scan(step.scan_lines.value_or(0), tip.material);
  if (std::exchange(guidance_, step.guidance) != step.guidance) say_({step.guidance, SpeechKind::Guidance});
}

// Reports a scan's lines, up to ten a second. The guidance names the scan: only the first line explains its sound.
void Narrator::follow_scan(std::uint32_t lines, std::int32_t material) {
  const std::uint32_t before = std::exchange(scan_lines_, lines);
  if (before >= lines) return;
  const Heard line{.event = HeardEvent::ScanLine, .time_ns = clock_.now_ns(), .material = material};
  if (!is_told(line.event, telling_)) return;
  signal_(line);
  if (before == 0) captions_.add(line.event, caption_of(phrases_, line, title(material)), line.time_ns);
}

void Narrator::say_state(const scene::TipState& tip) {
  if (telling_ != Telling::All) return say_({guidance_, SpeechKind::Event});
  std::string text = last_ ? said_of(phrases_, *last_, title(last_->material)) + ". " : "";
  text += said_of_state(phrases_, tip, title(tip.material), guidance_);
  say_({std::move(text), SpeechKind::Event});
}

void Narrator::note(const std::string& text) {
  captions_.add(HeardEvent::SampleChosen, text, clock_.now_ns());
  say_({text, SpeechKind::Event});
}

}  // namespace afm::exhibit
