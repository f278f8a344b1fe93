// SPDX-License-Identifier: Apache-2.0
// Task among particles: its score, its texts, and a wall that is dark until it is done.
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/live/particles_control.h"
#include "app/view/live_sound.h"
#include "app/view/servo_supervisor.h"
#include "app/view/view_choice.h"
#include "app/view/view_parts.h"
#include "core/log.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/panels/blind_task_words.h"
#include "exhibit/sound/jam_watch.h"
#include "exhibit/state/particle_task.h"
#include "exhibit/words/guidance.h"
#include "physics/quantity_text.h"
#include "scene/samples/particle_set.h"
#include "servo/live_picture.h"
#include "servo/servo_client.h"

namespace afm::app {

void ParticlesControl::follow_jam() {
  const auto held_n = jam_->add(now_.push);
  if (!held_n || parts_.turn.dark) return;  // its force would give an answer away
  core::log_line(fmt::format("jammed: the particles hold against {}",
                             physics::format_quantity(physics::Force(*held_n), physics::kForceUnits, 3)));
  parts_.sound.narrator().happened(exhibit::HeardEvent::ParticleJammed, parts_.servo.link().tip().material, *held_n);
}

// Begins the task for a new servo, with every particle at its start and no push to take back.
void ParticlesControl::begin_task() {
  if (task_) task_ = std::make_unique<exhibit::ParticleTask>(set_);
  now_.score = {};
}

void ParticlesControl::follow_task() {
  if (set_.blind && parts_.choice.guided()) return;  // the steps of the lesson are the tasks
  const bool ends = task_->look(parts_.servo.link().particle_pages(), parts_.servo.picture());
  now_.score = task_->score();
  if (set_.blind) follow_blind();
  if (!ends) return;
  core::log_line((set_.blind ? "the task is done: " : "the pattern is done: ") + scene::text_of(now_.score));
  parts_.sound.narrator().happened(set_.blind ? exhibit::HeardEvent::BlindTaskDone : exhibit::HeardEvent::PatternDone,
                                   parts_.servo.link().tip().material);
}

void ParticlesControl::follow_blind() {
  exhibit::Narrator& narrator = parts_.sound.narrator();
  const bool dark = task_->dark();
  if (std::exchange(parts_.turn.dark, dark) != dark) {
    const exhibit::Phrases& phrases = parts_.stage.phrases();
    core::log_line(dark ? "the picture is dark until the task is done" : "the picture is shown again");
    narrator.note(phrases[dark ? exhibit::Phrase::PictureDark : exhibit::Phrase::PictureShown]);
    // a threshold is to be felt alone
    const bool felt = dark && set_.blind->kind == scene::BlindKind::Threshold;
    parts_.sound.set_tones(!felt);
    narrator.set_telling(felt ? exhibit::Narrator::Telling::Force : exhibit::Narrator::Telling::All);
  }
  const bool far = dark && task_->far_enough(parts_.servo.link().particle_pages());
  if (!std::exchange(far_enough_, far) && far) {
    core::log_line("far enough: lift the tip");
    narrator.happened(exhibit::HeardEvent::ParticleFarEnough, parts_.servo.link().tip().material);
  }
}

std::optional<std::string> ParticlesControl::guidance(const exhibit::Phrases& phrases) const {
  const scene::TipState& tip = parts_.servo.link().tip();
  const bool marks = scene::leaves_marks(*now_.set) && exhibit::pushes_particles(tip) &&
                     tip.servo_state == scene::ServoState::Running && tip.phase != physics::Phase::WaitForLift;
  if (set_.blind && !parts_.choice.guided() && tip.servo_state == scene::ServoState::Running) {
    if (auto line = exhibit::blind_guidance(*set_.blind, now_.score, far_enough_, phrases)) return line;
  }
  if (!marks) return std::nullopt;
  const bool on = tip.phase == physics::Phase::Attached;
  if (now_.set->ink) return phrases[on ? exhibit::Phrase::InkMove : exhibit::Phrase::InkTouch];
  return phrases[on ? exhibit::Phrase::SoftDrag : exhibit::Phrase::SoftPress];
}

}  // namespace afm::app
