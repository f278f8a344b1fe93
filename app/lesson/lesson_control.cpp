// SPDX-License-Identifier: Apache-2.0
#include "app/lesson/lesson_control.h"

#include <array>
#include <glm/geometric.hpp>
#include <utility>

#include "app/view/live_sound.h"
#include "app/view/servo_supervisor.h"
#include "app/view/view_choice.h"
#include "app/view/view_hand.h"
#include "app/view/view_panels.h"
#include "app/view/view_parts.h"
#include "app/view/view_wand.h"
#include "exhibit/frame/blank_picture.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/recorded_wall.h"
#include "exhibit/lesson/live_lesson.h"
#include "exhibit/panels/panel_hit.h"
#include "exhibit/scenery/lines_on_sample.h"
#include "exhibit/sound/narrator.h"
#include "exhibit/state/moment.h"
#include "servo/servo_client.h"
#include "servo/wall_frame.h"

namespace afm::app {

LessonControl::LessonControl(ViewParts& parts, exhibit::LiveLesson& lesson) : parts_(parts), lesson_(lesson) {
  parts_.choice.set_guide(*this);
  parts_.servo.hear([this](const scene::TipSample& sample) { lesson_.felt(sample, parts_.servo.link()); });
  parts_.servo.hear_events([this](const scene::TipEvent& event) {
    if (event.kind != physics::EventKind::Slip) lesson_.happened(event, parts_.servo.link());
  });
}

void LessonControl::skip() { lesson_.skip(); }

void LessonControl::try_again() { lesson_.try_again(); }

bool LessonControl::number(std::size_t number) {
  if (lesson_.chooses_sample()) return false;
  lesson_.number(number);
  return true;
}

void LessonControl::step(int steps) { lesson_.step(steps); }

// Handles Enter, which always removes the force. Without a force, in a lesson that waits for it, it only continues.
void LessonControl::enter() {
  const bool waits = !lesson_.prompt().by_hand();
  if (!waits || parts_.servo.link().tip().servo_state != scene::ServoState::Disarmed) parts_.choice.stop_force();
  if (lesson_.over()) parts_.turn.leaving = true;
  lesson_.enter();
}

// Handles the choice of an answer or, if allowed, of a sample.
void LessonControl::press(const Pointed& pointed, const input::Ray& ray) {
  if (const auto target = target_at(ray)) return lesson_.press(*target);
  if (pointed.swatch && lesson_.chooses_sample()) parts_.choice.choose(*pointed.swatch);
}

std::optional<exhibit::LessonTarget> LessonControl::target_at(const input::Ray& ray) const {
  const exhibit::WallScene& wall = parts_.stage.wall_scene;
  const auto targets = lesson_.targets();
  const exhibit::LessonPlaces places = exhibit::lesson_places(wall.places().parameters(), targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (exhibit::hit_of(ray, places.targets[i], wall.panel_millimetre_m())) return targets[i];
  }
  return std::nullopt;
}

void LessonControl::follow_hand() {
  if (!parts_.servo.running() || parts_.hand.source() == HandSource::Simulated) return;
  const scene::TipState& tip = parts_.servo.link().tip();
  const glm::dvec3 normal = glm::dmat3(parts_.wand.navigation()) * parts_.stage.wall_scene.sample_normal();
  const glm::dvec3 place_m(tip.hand.position_m[0], tip.hand.position_m[1], tip.hand.position_m[2]);
  lesson_.hand_moved(glm::dot(place_m, glm::normalize(normal)), tip.presses);
}

bool LessonControl::asks() const { return lesson_.takes_hand() && parts_.hand.source() != HandSource::Simulated; }

void LessonControl::update(const ViewFrame& frame) {
  follow_hand();
  lesson_.update();
  if (parts_.sound.lacks_card()) lesson_.sound_is_lost();
  parts_.sound.set_tones(lesson_.has_tones());
  using Telling = exhibit::Narrator::Telling;
  exhibit::Narrator& narrator = parts_.sound.narrator();
  narrator.set_telling(asks() ? Telling::Faults : lesson_.prompt().hidden ? Telling::Force : Telling::All);
  if (const auto marked = lesson_.newly_marked()) narrator.note(*marked);
  const bool far_enough = lesson_.prompt().far_enough;
  if (!std::exchange(far_enough_, far_enough) && far_enough) {
    narrator.happened(exhibit::HeardEvent::ParticleFarEnough, parts_.servo.link().tip().material);
  }
  if (!parts_.servo.running()) return;
  lesson_.look(parts_.servo.link());
  lesson_.lay_sample(parts_.servo.link());
  if (lesson_.needs_particles_back()) put_particles_back(frame.now_ns);
  if (asks() || !lesson_.has_force()) parts_.choice.keep_force_away(frame.now_ns);
}

// Requests the particles' return, which the servo only carries out without a force.
void LessonControl::put_particles_back(std::int64_t now_ns) {
  parts_.choice.keep_force_away(now_ns);
  servo::ServoClient& servo = parts_.servo.link();
  const scene::TipState& tip = servo.tip();
  if (scene::is_armed(tip.servo_state) || tip.hand.force_n != std::array<double, 3>{}) return;
  if (lesson_.orders_particles_back()) servo.put_particles_back(now_ns);
}

// Hides blind samples: they look like the first one and have no labels; a tapping lever rests, and no ring
// shows its jumps.
void LessonControl::add_to_moment(exhibit::Moment& now, ViewFrame& /*frame*/) {
  if (!lesson_.prompt().hidden) return;
  if (now.wall.material) now.wall.material = 0;
  now.wall.release_z_m = 0;
  now.wall.swing = {};
  now.wall.cue = {};
  now.curves = {};
}

void LessonControl::add_to_session(servo::WallFrame& shown) const {
  const exhibit::LinesToWrite* const lines = lesson_.prompt().lines;
  if (lines != nullptr && lesson_.shows_scene()) shown.lines = exhibit::recorded_lines(*lines);
}

void LessonControl::add_to_picture(render::FrameState& picture, const ViewFrame& /*frame*/) {
  const render::PanelPlacement words = parts_.stage.wall_scene.places().parameters();
  const render::PanelPlacement banner = picture.panels.banner.placement;
  const exhibit::LinesToWrite* const lines = lesson_.prompt().lines;
  if (lines != nullptr) exhibit::add_lines(*lines, parts_.stage.wall_scene, picture);
  if (!lesson_.shows_scene()) {
    exhibit::blank(picture);
    picture.panels.banner.placement = banner;
  }
  // the words take the place of the figures of particles and marks, which take that of the curve
  if (picture.panels.particles.placement != render::kNoPlacement) {
    picture.panels.particles.placement = std::exchange(picture.panels.force.placement, render::kNoPlacement);
  }
  if (lesson_.prompt().hidden) {
    picture.panels.force.placement = render::kNoPlacement;
    picture.panels.banner.content.scale.clear();
  }
  if (parts_.panels.shown() == "keys") {
    picture.panels.keys.placement = parts_.stage.wall_scene.places().keys();
    return;
  }
  const auto targets = lesson_.targets();
  const exhibit::LessonPlaces places = exhibit::lesson_places(words, targets.size());
  picture.panels.data.content = lesson_.panel();
  picture.panels.data.placement = places.words;
  picture.panels.control.placement = render::kNoPlacement;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    picture.labels.push_back(
        {.text = targets[i].text, .highlighted = targets[i].marked, .placement = places.targets[i]});
  }
}

// Question, or how to continue, in the line above the wall while the hand has nothing to do.
std::optional<std::string> LessonControl::guidance(const exhibit::Phrases& phrases) const {
  const exhibit::LessonPrompt& prompt = lesson_.prompt();
  if (prompt.by_hand()) {
    return lesson_.has_force() ? std::nullopt : std::optional(prompt.words);
  }
  if (prompt.wants == exhibit::LessonPrompt::Wants::GoOn) return phrases[exhibit::Phrase::LessonPressEnter];
  return prompt.words.size() <= exhibit::kLine ? prompt.words : prompt.title;
}

// Speaks the text of a prompt once, before the next step of the hand.
std::string LessonControl::spoken(const std::string& line) {
  const bool by_hand = lesson_.prompt().by_hand();
  std::string words = lesson_.speech();
  if (!by_hand) return words;
  if (std::exchange(said_, words) != words) line_ = line;
  return line == line_ ? words + " " + line : line;
}

void LessonControl::restart(Restart what) {
  if (what != Restart::Visitor) lesson_.forget_laid();
  if (what == Restart::Servo && lesson_.prompt().moves_matter()) lesson_.try_again();
}

}  // namespace afm::app
