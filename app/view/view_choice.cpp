// SPDX-License-Identifier: Apache-2.0
#include "app/view/view_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <string_view>
#include <vector>

#include "app/view/live_sound.h"
#include "app/view/parameter_edits.h"
#include "app/view/servo_supervisor.h"
#include "app/view/view_guide.h"
#include "app/view/view_hand.h"
#include "app/view/view_panels.h"
#include "core/clock.h"
#include "core/log.h"
#include "exhibit/frame/exhibit_setup.h"
#include "input/selection.h"
#include "physics/friction/friction.h"
#include "servo/servo_client.h"

namespace afm::app {

namespace {

constexpr std::int64_t kForceTakenNs = 500'000'000;  // longest time a new selection needs to remove the force

// Words of --friction that enable friction, the richest law first.
std::string felt_laws() {
  std::vector<std::string_view> words;
  for (const physics::FrictionLawText& row : physics::kFrictionLaws) {
    if (row.law != physics::FrictionLaw::None) words.insert(words.begin(), row.word);
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

ViewChoice::ViewChoice(ViewParts& parts, const std::vector<curves::SampleModel>& materials, const Settings& settings)
    : parts_(parts), felt_(materials), scale_(settings.scale), first_material_(settings.first_material) {}

void ViewChoice::follow_edits(std::int64_t now_ns) {
  if (parts_.servo.running()) {
    parts_.panels.take_built(parts_.servo.link());
    if (parts_.panels.edits().keeps_force_off(parts_.servo.link().tip())) keep_force_away(now_ns);
  }
  if (!parts_.panels.edits().take_felt(parts_.servo.link().tip(), felt_)) return;
  const std::size_t current = *parts_.servo.material();
  parts_.sound.set_ear(current, felt_[current]);
  core::log_line("the changed parameters are now in effect");
}

std::string ViewChoice::spoken(const std::string& line) const {
  return guide_ == nullptr ? line : guide_->spoken(line);
}

void ViewChoice::choose(std::size_t material) {
  if (!parts_.servo.running() || material >= felt_.size()) return;
  parts_.servo.link().choose(static_cast<std::int32_t>(material), scale_, settings_);
  if (parts_.hand.source() == HandSource::Simulated) parts_.hand.begin_person(material, parts_.clock.now_ns());
  core::log_line("chosen: " + parts_.stage.materials.materials[material].title);
}

void ViewChoice::choose_first(std::optional<std::size_t> chosen_before) {
  if (const auto material = chosen_before ? chosen_before : first_material_) choose(*material);
}

void ViewChoice::number(std::size_t number) {
  if (guide_ == nullptr || !guide_->number(number)) choose(number);
}

void ViewChoice::press(const Pointed& pointed, const input::Ray& ray) {
  if (parts_.panels.close_keys()) return;  // list that covers all targets
  if (guide_ != nullptr) return guide_->press(pointed, ray);
  // a swatch that the ray has only snapped to does not hide the sample
  const bool beside =
      !pointed.control && !pointed.tab && !input::pick(ray, 0.0, parts_.stage.wall_scene.swatch_targets());
  if (beside && press_on_sample_ && press_on_sample_(ray)) return;
  if (pointed.swatch) choose(*pointed.swatch);
  if (const auto material = parts_.servo.material()) {
    parts_.panels.press(pointed, *material, parts_.servo.running() ? &parts_.servo.link() : nullptr);
  }
}

void ViewChoice::enter() {
  if (guide_ != nullptr) return guide_->enter();
  stop_force();
}

// Selects the next scale. It takes effect once the tip is off the sample, like another material.
void ViewChoice::next_scale() {
  const bool has_particles = parts_.servo.running() && scene::are_there(parts_.servo.link().model().particles);
  scale_ = scene::after(scale_, has_particles);
  const scene::ScaleModeText& text = scene::text_of(scale_);
  core::log_line(fmt::format("scale {}: {}", text.word, text.meaning));
  choose_again();
}

void ViewChoice::choose_settings(const scene::PushSettings& settings) {
  settings_ = settings;
  choose_again();
}

// The sample may still be on its way.
void ViewChoice::choose_again() {
  if (!parts_.servo.running() || parts_.servo.link().chosen() < 0) return;
  parts_.servo.link().choose(parts_.servo.link().chosen(), scale_, settings_);
}

void ViewChoice::mark_next_setting() {
  if (const auto material = parts_.servo.material()) parts_.panels.mark_next(*material);
}

void ViewChoice::step_setting(int steps) {
  if (guide_ != nullptr) return guide_->step(steps);
  if (const auto material = parts_.servo.material()) {
    parts_.panels.step_marked(steps, *material, parts_.servo.running() ? &parts_.servo.link() : nullptr);
  }
}

void ViewChoice::toggle_friction_loop() {
  const auto material = parts_.servo.material();
  if (!material) return core::log_line("friction loop: choose a sample first");
  const bool shown = parts_.panels.toggle_friction_loop();
  if (felt_[*material].taps()) return core::log_line(fmt::format("dial of the swing: {}", shown ? "shown" : "hidden"));
  if (!shown) return core::log_line("friction loop: hidden");
  const physics::FrictionLaw law = felt_[*material].parameters.friction.law;
  core::log_line(law == physics::FrictionLaw::None
                     ? "friction loop: friction is off; start with --friction " + felt_laws()
                     : std::string("friction loop: shown, friction ") + std::string(physics::text_of(law).word));
}

void ViewChoice::stop_force() {
  if (parts_.servo.running()) parts_.servo.link().stop(parts_.clock.now_ns());
}

void ViewChoice::take_force_away(std::int64_t now_ns) {
  force_taken_ns_ = now_ns;
  if (parts_.servo.running()) parts_.servo.link().take_force_away();
}

void ViewChoice::keep_force_away(std::int64_t now_ns) {
  const scene::ServoState state = parts_.servo.link().tip().servo_state;
  const bool force = state == scene::ServoState::Arming || state == scene::ServoState::Running;
  if (force && now_ns - force_taken_ns_ > kForceTakenNs) take_force_away(now_ns);
}

}  // namespace afm::app
