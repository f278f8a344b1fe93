// SPDX-License-Identifier: Apache-2.0
#include "app/live/particles_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "app/view/live_sound.h"
#include "app/view/servo_supervisor.h"
#include "app/view/view_choice.h"
#include "app/view/view_parts.h"
#include "core/clock.h"
#include "core/log.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/panels/push_setting_words.h"
#include "exhibit/scenery/push_planner.h"
#include "exhibit/sound/jam_watch.h"
#include "exhibit/state/moment.h"
#include "exhibit/state/particle_task.h"
#include "exhibit/words/guidance.h"
#include "haptics/device.h"
#include "haptics/felt_particles.h"
#include "physics/quantity_text.h"
#include "scene/samples/adjusted_set.h"
#include "scene/samples/particle_set.h"
#include "scene/shared/push_values.h"
#include "servo/live_picture.h"
#include "servo/servo_client.h"

namespace afm::app {

namespace {

// Log texts about actions that can be taken back.
struct StrokeWords {
  const char *none, *last, *all;
};

constexpr StrokeWords kPushes{"take back: no push has moved a particle", "take back: the last push",
                              "take back: all pushes"};
constexpr StrokeWords kScratches{"take back: no scratch has marked the sample", "take back: the last scratch",
                                 "take back: all scratches"};
constexpr StrokeWords kStrokes{"take back: no ink is on the sample", "take back: the last stroke",
                               "take back: all strokes"};

const StrokeWords& words_of(const scene::ParticleSet& set) {
  if (set.ink) return kStrokes;
  return set.soft ? kScratches : kPushes;
}

constexpr const char* kNoLevelIfBlind = "no level: the task of this set is done without a picture";

// Loads of a look in units of the gentle one; the initial one first.
constexpr std::array kLookLoads{0.5, 2.0, 5.0};

std::uint32_t piconewtons(double n) { return static_cast<std::uint32_t>(std::max(1L, std::lround(1e12 * n))); }

std::string text_of(physics::Force force) { return physics::format_quantity(force, physics::kForceUnits, 3); }

using scene::PushSetting;
using scene::PushSettings;
using scene::PushTool;

exhibit::Phrase phrase_of(scene::PushRefusal::Why why) {
  using Why = scene::PushRefusal::Why;
  switch (why) {
    case Why::Marks:
      return exhibit::Phrase::ToolOfMarks;
    case Why::NoAdhesion:
      return exhibit::Phrase::ToolNeedsAdhesion;
    case Why::Picture:
      return exhibit::Phrase::ToolOfPicture;
    case Why::NoNumbers:
      return exhibit::Phrase::SettingNoNumbers;
    case Why::Lever:
      break;
  }
  return exhibit::Phrase::ToolTooMuch;
}

}  // namespace

ParticlesControl::ParticlesControl(ViewParts& parts, const scene::ParticleSet& set)
    : parts_(parts),
      set_(set),
      now_{.set = &set, .look_load_n = kLookLoads.front() * exhibit::gentle_look(set).si},
      planner_(std::make_unique<exhibit::PushPlanner>(set)),
      shown_(std::make_unique<exhibit::WallState>()),
      adjusted_(std::make_unique<scene::AdjustedSet>(set)),
      jam_(std::make_unique<exhibit::JamWatch>()) {
  parts_.choice.set_press_on_sample([this](const input::Ray& ray) { return point(ray); });
  if (!scene::has_task(set)) return;
  task_ = std::make_unique<exhibit::ParticleTask>(set);
  parts_.servo.hear([this](const scene::TipSample& sample) { task_->add(sample, parts_.servo.picture() == nullptr); });
  parts_.servo.hear_events([this](const scene::TipEvent& event) { task_->add(event); });
}

ParticlesControl::~ParticlesControl() = default;

void ParticlesControl::take_back() {
  if (!parts_.servo.running()) return;
  if (const servo::LivePicture* picture = parts_.servo.picture(); picture != nullptr && picture->now().level > 1) {
    return core::log_line(
        "take back: no push at level 2, where the sample has drifted since; R puts all particles back");
  }
  const StrokeWords& words = words_of(*now_.set);
  if (parts_.servo.link().push().strokes == 0) return core::log_line(words.none);
  core::log_line(words.last);
  give(Order::TakeBack);
}

void ParticlesControl::plan_next_particle() {
  core::log_line(planner_->next_particle(now_));
  send_plan();
}

void ParticlesControl::plan_next_place() {
  core::log_line(planner_->next_place(now_));
  send_plan();
}

void ParticlesControl::toggle_groove() {
  core::log_line(planner_->toggle_groove());
  send_plan();
}

void ParticlesControl::look_again() {
  if (!parts_.servo.running()) return;
  const servo::LivePicture* picture = parts_.servo.picture();
  if (picture == nullptr)
    return core::log_line("look again: the particles themselves are shown; level 1 or 2 hides them");
  if (picture->looks()) return core::log_line("look again: a look goes on");
  if (!picture->lifted()) core::log_line("look again: as soon as the tip is lifted off the particles");
  order_ = Order::Look;
}

void ParticlesControl::next_look_load() {
  if (parts_.servo.picture() == nullptr)
    return core::log_line("load of a look: the particles themselves are shown; level 1 or 2 hides them");
  look_load_ = (look_load_ + 1) % kLookLoads.size();
  const physics::Force gentle = exhibit::gentle_look(*now_.set), load = kLookLoads[look_load_] * gentle;
  now_.look_load_n = load.si;
  core::log_line(fmt::format("load of a look: {}, {} {}", text_of(load),
                             load > gentle ? "which pushes particles away; gentle up to" : "gentle; the most is",
                             text_of(gentle)));
}

// Continues a look until it ends, once a frame.
void ParticlesControl::sweep(const ViewFrame& frame) {
  const servo::LivePicture* picture = parts_.servo.picture();
  const auto square = picture != nullptr ? picture->square() : std::nullopt;
  const bool hard = now_.look_load_n > exhibit::gentle_look(*now_.set).si;
  if (!square || !(hard || sweeps_)) {
    if (std::exchange(sweeps_, false)) parts_.servo.link().lead({});
    return;
  }
  sweeps_ = true;
  parts_.servo.link().lead({.time_ns = frame.now_ns,
                            .apex_xy_m = {square->middle_m.x, square->middle_m.y},
                            .height_m = square->half_m,
                            .hand = scene::ScanHand::Looks,
                            .load_pn = piconewtons(now_.look_load_n)});
}

std::optional<scene::PushRefusal> ParticlesControl::refusal(const PushSettings& settings) const {
  using Why = scene::PushRefusal::Why;
  const servo::ServoClient& link = parts_.servo.link();
  const scene::SharedParticles& particles = link.model().particles;
  if (auto refused = scene::refusal(particles, settings)) return refused;
  if (set_.blind && settings.level > 1) return scene::PushRefusal{Why::Picture, kNoLevelIfBlind};
  const auto scale = haptics::adjusted_scale(particles, settings, haptics::spec_of(link.device()));
  return scale ? std::nullopt : std::optional(scene::PushRefusal{Why::Lever, scale.error().message});
}

void ParticlesControl::choose_next(PushSetting setting) {
  if (!parts_.servo.running()) return;
  const scene::SharedParticles& particles = parts_.servo.link().model().particles;
  const PushSettings& chosen = parts_.choice.settings();
  const scene::PushSettingText& row = scene::text_of(setting);
  const exhibit::Phrases& phrases = parts_.stage.phrases();
  const std::uint16_t before = scene::value_of(chosen, setting);
  std::optional<scene::PushRefusal> refused;
  for (std::uint16_t i = 1; i < row.values; ++i) {
    const auto value = static_cast<std::uint16_t>((before + i) % row.values);
    if (value != 0 && !scene::differs(particles, setting, value)) continue;
    const PushSettings next = scene::with(chosen, setting, value);
    const std::string text = fmt::format("{} {}", row.name, exhibit::value_text(setting, value, set_));
    if (auto why = refusal(next)) {
      core::log_line(fmt::format("{}: not here; {}", text, why->text));
      refused = std::move(why);
      continue;
    }
    return choose(next, text);
  }
  if (!refused) core::log_line(fmt::format("{}: no other here", row.name));
  parts_.sound.narrator().note(refused
                                   ? phrases[phrase_of(refused->why)]
                                   : phrases.text<exhibit::Phrase::SettingNoOther>(exhibit::name_of(setting, phrases)));
}

void ParticlesControl::choose(const PushSettings& settings, const std::string& text) {
  if (exhibit::touched(now_, set_.particles.size())) {
    core::log_line(
        fmt::format("{}: not while the tip touches particle {}; go back from it", text, now_.push.particle + 1));
    parts_.sound.narrator().note(parts_.stage.phrases()[exhibit::Phrase::ToolWaits]);
  }
  core::log_line(fmt::format("{}: as soon as the tip is off the sample and the particles, without force", text));
  parts_.choice.choose_settings(settings);
}

void ParticlesControl::mark_next_setting() {
  const exhibit::Phrases& phrases = parts_.stage.phrases();
  marked_ = marked_ ? (*marked_ + 1) % (scene::kPushSettings.size() + 1) : 0;
  std::string name = phrases[exhibit::Phrase::LookLoad];
  std::string value = phrases.number(text_of(physics::Force(now_.look_load_n)));
  std::string line = "load of a look " + text_of(physics::Force(now_.look_load_n));
  if (*marked_ < scene::kPushSettings.size()) {
    const scene::PushSettingText& row = scene::kPushSettings.at(*marked_);
    const std::uint16_t number = scene::value_of(parts_.choice.settings(), row.setting);
    name = exhibit::name_of(row.setting, phrases);
    value = exhibit::value_name(row.setting, number, set_, phrases);
    line = fmt::format("{} {}", row.name, exhibit::value_text(row.setting, number, set_));
  }
  core::log_line(fmt::format("setting: {}; Delete chooses the next", line));
  parts_.sound.narrator().note(phrases.text<exhibit::Phrase::SettingMarked>(name, value));
}

void ParticlesControl::change_marked_setting() {
  if (!marked_) mark_next_setting();
  if (*marked_ == scene::kPushSettings.size()) return next_look_load();
  choose_next(scene::kPushSettings.at(*marked_).setting);
}

void ParticlesControl::follow_settings() {
  adjusted_->use(now_.push.settings);
  now_.set = &adjusted_->set();
  now_.limits = &adjusted_->limits();
  const PushSettings& now = now_.push.settings;
  const PushSettings before = std::exchange(settings_, now);
  if (now != before) now_.look_load_n = kLookLoads[look_load_] * exhibit::gentle_look(*now_.set).si;
  if (before.tool == PushTool::OfSet || now.tool == PushTool::OfSet) return;
  const exhibit::Phrases& phrases = parts_.stage.phrases();
  for (const scene::PushSettingText& row : scene::kPushSettings) {
    const std::uint16_t value = scene::value_of(now, row.setting);
    if (value == scene::value_of(before, row.setting)) continue;
    const bool tool = row.setting == PushSetting::Tool;
    core::log_line(fmt::format("{} {}: {}", row.name, exhibit::value_text(row.setting, value, set_),
                               tool ? scene::text_of(now.tool).meaning : "in use"));
    parts_.sound.narrator().note(
        tool ? phrases[now.tool == PushTool::Grip ? exhibit::Phrase::ToolNowGrip : exhibit::Phrase::ToolNowPush]
             : phrases.text<exhibit::Phrase::SettingNow>(exhibit::name_of(row.setting, phrases),
                                                         exhibit::value_name(row.setting, value, set_, phrases)));
  }
}

bool ParticlesControl::point(const input::Ray& ray) {
  const auto unplanned = [this] { return planner_->plan().particle == scene::kNoParticle; };
  const bool begins = unplanned();
  const auto on_sample = exhibit::ray_on_sample(parts_.stage.wall_scene, *shown_, ray);
  const auto planned = on_sample ? planner_->point(*on_sample, now_) : std::nullopt;
  if (!planned) return false;
  if (begins && unplanned() && parts_.servo.picture() != nullptr) {  // first point, on the bare sample
    look_again();
    return true;
  }
  core::log_line(*planned);
  send_plan();
  return true;
}

void ParticlesControl::send_plan() {
  now_.plan = planner_->plan();
  if (parts_.servo.running()) parts_.servo.link().plan(now_.plan);
}

void ParticlesControl::restart(Restart what) {
  if (what == Restart::Visitor) {
    parts_.choice.choose_settings({});
    marked_.reset();
    look_load_ = 0;
    now_.look_load_n = kLookLoads.front() * exhibit::gentle_look(*now_.set).si;
  }
  order_ = Order::None;
  planner_->clear();
  send_plan();
  if (what == Restart::Servo) return begin_task();
  if (!parts_.servo.running() || !parts_.servo.material()) return;
  core::log_line(words_of(*now_.set).all);
  give(Order::PutBack);
}

void ParticlesControl::give(Order order) {
  order_ = order;
  parts_.choice.take_force_away(parts_.clock.now_ns());
}

void ParticlesControl::update(const ViewFrame& frame) {
  const servo::ServoClient& link = parts_.servo.link();
  const servo::LivePicture* picture = parts_.servo.picture();
  const bool measured = picture != nullptr && !picture->shown().empty();  // not yet, right after a change of the level
  now_.pages = measured ? picture->shown() : link.particle_pages();
  now_.picture = picture != nullptr ? &picture->now() : nullptr;
  now_.push = link.push();
  now_.tiles = link.mark_tiles();
  now_.marks = link.marks();
  if (!parts_.servo.running()) return;
  follow_settings();
  follow_jam();
  if (task_) follow_task();
  sweep(frame);
  if (order_ != Order::None) carry_out(frame.now_ns);
}

void ParticlesControl::carry_out(std::int64_t now_ns) {
  servo::ServoClient& servo = parts_.servo.link();
  if (order_ == Order::Look) {
    const servo::LivePicture* picture = parts_.servo.picture();
    if (picture != nullptr && !picture->lifted()) return;
    order_ = Order::None;
    return servo.look_again(now_ns);
  }
  const scene::TipState& tip = servo.tip();
  if (scene::is_armed(tip.servo_state) || tip.hand.force_n != std::array<double, 3>{}) return;
  if (std::exchange(order_, Order::None) == Order::TakeBack) {
    servo.take_back_push(now_ns);
  } else {
    servo.put_particles_back(now_ns);
  }
}

void ParticlesControl::add_to_moment(exhibit::Moment& now, ViewFrame& /*frame*/) {
  now.wall.particles = &now_;
  *shown_ = now.wall;
}

}  // namespace afm::app
