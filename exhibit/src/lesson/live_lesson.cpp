// SPDX-License-Identifier: Apache-2.0
#include "exhibit/lesson/live_lesson.h"

#include <algorithm>
#include <utility>

#include "core/clock.h"
#include "core/log.h"
#include "servo/servo_client.h"

namespace afm::exhibit {

namespace {

using Wants = LessonPrompt::Wants;

constexpr double kPutBackS = 1.0;  // interval between two requests, since the servo drops one that comes too early

}  // namespace

LiveLesson::LiveLesson(const Lesson& lesson, const std::vector<curves::SampleModel>& samples, const Phrases& phrases,
                       const std::optional<DataSetEntry>& study, const core::Clock& clock)
    : lesson_(lesson),
      samples_(samples),
      phrases_(phrases),
      study_(study),
      clock_(clock),
      run_(
          lesson, samples, phrases,
          {.seed = study ? study->seed : static_cast<std::uint64_t>(clock.now_ns()),
           .order = study ? study->order.value_or(0) : 0,
           .ask_consent = study.has_value()},
          [this](const TrialRow& row) { return keep(row); }, now_s()),
      varied_(samples.size(), false) {
  acted();
}

void LiveLesson::update() {
  run_.watch_time(now_s());
  LessonPrompt next = run_.prompt(now_s());
  if (next.words != prompt_.words || next.progress != prompt_.progress) {
    const bool scale = is_scale(next);
    mark_.ask(next.answers.size(), scale ? HandAnswer::Layout::Scale : HandAnswer::Layout::List,
              scale ? std::optional(next.marked) : std::nullopt);
    told_mark_ = mark_.marked();
    core::log_line("lesson: " + (next.progress.empty() ? "" : next.progress + ": ") + next.words);
  }
  prompt_ = std::move(next);
}

// Call after each action: the files begin with the consent, and end with the lesson.
void LiveLesson::acted() {
  if (study_ && run_.consented() && !data_ && !error_) {
    if (auto begun = begin_data(); !begun) {
      error_ = begun.error();
      run_.stop();
    }
  }
  update();
}

core::Result<void> LiveLesson::begin_data() {
  auto data = DataSet::create(lesson_, *study_);
  if (!data) return tl::unexpected(data.error());
  data_ = std::move(*data);
  core::log_line("lesson: results go to " + data_->participant_folder());
  return {};
}

core::Result<void> LiveLesson::keep(const TrialRow& row) {
  if (row.correct && !row.practice) {
    ++judged_;
    if (*row.correct) ++right_;
  }
  return data_ ? data_->add(row) : core::Result<void>{};
}

void LiveLesson::sound_is_lost() {
  if (!data_ || error_ || over() || std::exchange(sound_lost_noted_, true)) return;
  core::log_line("lesson: the results say that there is no sound from now on");
  if (auto noted = data_->note_sound_lost(run_.elapsed_s(now_s())); !noted) error_ = noted.error();
}

InstructorState LiveLesson::instructor_state() const {
  return {.prompt = prompt_,
          .participant = study_ ? study_->code : "",
          .elapsed_s = run_.elapsed_s(now_s()),
          .planned_min = lesson_.minutes,
          .right = right_,
          .judged = judged_};
}

bool LiveLesson::chooses_sample() const { return prompt_.wants == Wants::Cycle && !prompt_.material; }

void LiveLesson::number(std::size_t number) {
  if (prompt_.wants != Wants::Answer || number >= prompt_.answers.size()) return;
  if (is_scale(prompt_)) {
    // the nine keys cover the whole scale
    return mark_.set_marked(number * (prompt_.answers.size() - 1) / (kMostNumberedAnswers - 1));
  }
  run_.answer(number, now_s());
  acted();
}

void LiveLesson::press(const LessonTarget& target) {
  using Action = LessonTarget::Action;
  switch (target.action) {
    case Action::Answer:
      return number(target.answer);
    case Action::Less:
      return step(-1);
    case Action::More:
      return step(1);
    case Action::Confirm:
    case Action::GoOn:
      return enter();
  }
}

void LiveLesson::enter() {
  const bool scale = prompt_.wants == Wants::Answer && is_scale(prompt_);
  if (scale) run_.answer(mark_.marked().value_or(prompt_.marked), now_s());
  if (!scale) run_.go_on(now_s());
  acted();
}

void LiveLesson::step(int steps) {
  if (prompt_.wants != Wants::Answer || !is_scale(prompt_)) return;
  const auto last = static_cast<int>(prompt_.answers.size()) - 1;
  const auto marked = static_cast<int>(mark_.marked().value_or(prompt_.marked));
  mark_.set_marked(static_cast<std::size_t>(std::clamp(marked + steps, 0, last)));
}

bool LiveLesson::takes_hand() const { return prompt_.wants == Wants::Answer; }

void LiveLesson::hand_moved(double height_m, std::uint64_t presses) {
  if (!mark_.add(height_m, presses, now_s())) return;
  if (prompt_.wants == Wants::GoOn) run_.go_on(now_s());
  if (prompt_.wants == Wants::Answer && mark_.marked()) run_.answer(*mark_.marked(), now_s());
  acted();
}

std::optional<std::string> LiveLesson::newly_marked() {
  if (prompt_.wants != Wants::Answer || told_mark_ == mark_.marked()) return std::nullopt;
  told_mark_ = mark_.marked();
  return told_mark_ ? std::optional(prompt_.answers[*told_mark_]) : std::nullopt;
}

void LiveLesson::skip() {
  core::log_line("lesson: skipped");
  run_.skip(now_s());
  acted();
}

void LiveLesson::try_again() {
  core::log_line("lesson: the trial begins again");
  run_.reset(now_s());
  laid_.reset();
  acted();
}

void LiveLesson::next() {
  run_.go_on(now_s());
  acted();
}

void LiveLesson::stop() {
  run_.stop();
  acted();
}

// True if the scene may be shown: a blind sample only if the condition includes the picture.
bool LiveLesson::shows_scene() const {
  if (prompt_.dark) return false;
  if (prompt_.condition) return *prompt_.condition != Condition::Haptics;
  return !prompt_.hidden;
}

bool LiveLesson::has_tones() const {
  if (takes_hand()) return false;
  // a threshold that is felt has no tones in any condition
  if (prompt_.dark && prompt_.hidden) return false;
  if (prompt_.condition) return *prompt_.condition == Condition::Sound;
  return !prompt_.hidden || prompt_.of_states;
}

bool LiveLesson::has_force() const { return prompt_.condition != Condition::Picture; }

void LiveLesson::lay_sample(servo::ServoClient& servo) {
  if (!prompt_.by_hand()) return;
  const Laid wanted{prompt_.task, prompt_.hidden ? prompt_.cycle : 0};
  if (laid_ == wanted) return;
  laid_ = wanted;
  edit_ = 0;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const bool variant = prompt_.variant && prompt_.material == i;
    if (!variant && !varied_[i]) continue;
    edit_ = servo.change(i, variant ? *prompt_.variant : samples_[i].parameters);
    varied_[i] = variant;
    if (!variant) edit_ = 0;
  }
  if (prompt_.material) servo.choose(static_cast<std::int32_t>(*prompt_.material), lesson_.scale);
}

void LiveLesson::felt(const scene::TipSample& sample, const servo::ServoClient& servo) {
  run_.force_is(hand_force(sample.servo_state, servo.tip().safety.thermal_gain), now_s());
  run_.add(sample, now_s());
}

void LiveLesson::happened(const scene::TipEvent& event, const servo::ServoClient& servo) {
  if (!physics::begins_cycle(event.kind) && !physics::ends_cycle(event.kind)) return run_.add(event);
  if (edit_ != 0 && servo.tip().active.edit_revision != edit_) return;
  run_.happened(event, now_s());
  acted();
}

void LiveLesson::look(const servo::ServoClient& servo) {
  if (!prompt_.moves_matter()) return;
  if (prompt_.wants == Wants::Push) run_.look(servo.particle_pages(), now_s());
  if (prompt_.wants == Wants::Write) run_.look_at_marks(servo.mark_tiles(), now_s());
  acted();
}

bool LiveLesson::orders_particles_back() {
  if (put_back_s_ && now_s() - *put_back_s_ < kPutBackS) return false;
  put_back_s_ = now_s();
  return true;
}

core::Result<void> LiveLesson::finish() {
  run_.stop();
  if (data_ && run_.end()) {
    if (auto finished = data_->finish(*run_.end()); !finished && !error_) error_ = finished.error();
  }
  if (!error_ && run_.error()) error_ = run_.error();
  if (error_) return tl::unexpected(*error_);
  return {};
}

double LiveLesson::now_s() const { return static_cast<double>(clock_.now_ns()) * 1e-9; }

}  // namespace afm::exhibit
