// SPDX-License-Identifier: Apache-2.0
// A lesson at the live window: a guide on top of everything else.
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "app/live/live_view.h"
#include "exhibit/blank_picture.h"
#include "exhibit/panel_hit.h"

namespace afm::app {

void LiveView::number(std::size_t number) {
  if (lesson_ == nullptr || lesson_->chooses_sample()) return choose(number);
  lesson_->number(number);
}

// Enter takes the force away whatever else it does. Where a lesson waits for it and there is none, it only goes on.
void LiveView::stop_or_go_on() {
  const bool waits = lesson_ != nullptr && lesson_->prompt().wants != exhibit::LessonPrompt::Wants::Cycle;
  if (!waits || servo_.link().tip().servo_state != scene::ServoState::Disarmed) stop_force();
  if (lesson_ == nullptr) return;
  if (lesson_->over()) leaving_ = true;
  lesson_->enter();
}

void LiveView::skip_step() {
  if (lesson_ != nullptr) lesson_->skip();
}

void LiveView::try_again() {
  if (lesson_ != nullptr) lesson_->try_again();
}

void LiveView::follow_lesson(std::int64_t now_ns) {
  if (lesson_ == nullptr) return;
  if (servo_.running() && hand() != HandSource::Simulated) {
    const scene::HandState& moved = servo_.link().tip().hand;
    const glm::dvec3 normal = glm::dmat3(view_wand_.navigation()) * stage_.wall_scene.sample_normal();
    const glm::dvec3 place_m(moved.position_m[0], moved.position_m[1], moved.position_m[2]);
    lesson_->hand_moved(glm::dot(place_m, glm::normalize(normal)), servo_.link().tip().presses);
  }
  lesson_->update();
  if (sound_.lacks_card()) lesson_->sound_is_lost();
  sound_.set_tones(lesson_->has_tones());
  using Telling = exhibit::Narrator::Telling;
  const bool asks = lesson_->takes_hand() && hand() != HandSource::Simulated;
  sound_.narrator().set_telling(asks ? Telling::Faults : lesson_->prompt().hidden ? Telling::Force : Telling::All);
  if (const auto marked = lesson_->newly_marked()) sound_.narrator().note(*marked);
  if (!servo_.running()) return;
  lesson_->lay_sample(servo_.link());
  const scene::ServoState state = servo_.link().tip().servo_state;
  const bool force = state == scene::ServoState::Arming || state == scene::ServoState::Running;
  if ((asks || !lesson_->has_force()) && force && now_ns - force_taken_ns_ > kForceTakenNs) take_force_away(now_ns);
}

std::optional<exhibit::LessonTarget> LiveView::lesson_target_at(const input::Ray& ray) const {
  const auto targets = lesson_->targets();
  const exhibit::LessonPlaces places = exhibit::lesson_places(stage_.wall_scene.parameter_placement(), targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (exhibit::hit_of(ray, places.targets[i], stage_.wall_scene.panel_millimetre_m())) return targets[i];
  }
  return std::nullopt;
}

// A press in a lesson: an answer, or a sample where it may be chosen.
void LiveView::press_in_lesson(const input::Ray& ray, const Pointed& pointed) {
  if (const auto target = lesson_target_at(ray)) return lesson_->press(*target);
  if (pointed.swatch && lesson_->chooses_sample()) choose(*pointed.swatch);
}

// A blind sample looks like the first one, whichever it is, and nothing is written beside it.
void LiveView::hide_sample(exhibit::Moment& now) const {
  if (lesson_ == nullptr || !lesson_->prompt().hidden) return;
  if (now.wall.material) now.wall.material = 0;
  now.wall.release_z_m = 0;
  now.curves = {};
}

void LiveView::add_lesson(render::FrameState& frame) {
  if (lesson_ == nullptr) return;
  const render::PanelPlacement banner = frame.panels.banner.placement;
  const bool keys = panels_.shown() == "keys";
  if (!lesson_->shows_scene()) {
    exhibit::blank(frame);
    frame.panels.banner.placement = banner;
  }
  if (lesson_->prompt().hidden) {
    frame.panels.force.placement = render::kNoPlacement;
    frame.panels.banner.content.scale.clear();
  }
  if (keys) {
    frame.panels.data.placement = stage_.wall_scene.parameter_placement();
    return;
  }
  const auto targets = lesson_->targets();
  const exhibit::LessonPlaces places = exhibit::lesson_places(stage_.wall_scene.parameter_placement(), targets.size());
  frame.panels.data.content = lesson_->panel();
  frame.panels.data.placement = places.words;
  frame.panels.control.placement = render::kNoPlacement;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    frame.labels.push_back({.text = targets[i].text, .highlighted = targets[i].marked, .placement = places.targets[i]});
  }
}

// Where the hand has nothing to do, the line above is the question, or how to go on.
std::optional<std::string> LiveView::lesson_guidance(const exhibit::Phrases& phrases) const {
  if (lesson_ == nullptr) return std::nullopt;
  const exhibit::LessonPrompt& prompt = lesson_->prompt();
  if (prompt.wants == exhibit::LessonPrompt::Wants::Cycle) {
    return lesson_->has_force() ? std::nullopt : std::optional(prompt.words);
  }
  if (prompt.wants == exhibit::LessonPrompt::Wants::GoOn) return phrases[exhibit::Phrase::LessonPressEnter];
  return prompt.words.size() <= exhibit::kLine ? prompt.words : prompt.title;
}

// The words of a prompt are spoken once, before the next step of the hand.
std::string LiveView::spoken_guidance() {
  std::string line = guidance(stage_.phrases());
  if (lesson_ == nullptr) return line;
  const bool by_hand = lesson_->prompt().wants == exhibit::LessonPrompt::Wants::Cycle;
  std::string words = lesson_->speech();
  if (!by_hand) return words;
  if (std::exchange(lesson_said_, words) != words) lesson_line_ = line;
  return line == lesson_line_ ? words + " " + line : line;
}

}  // namespace afm::app
