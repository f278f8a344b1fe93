// SPDX-License-Identifier: Apache-2.0
#include "full_panels.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "core/enumerators.h"
#include "exhibit/friction/friction_panel.h"
#include "exhibit/lesson/questionnaire.h"
#include "exhibit/panels/ink_panel.h"
#include "exhibit/panels/parameter_panel.h"
#include "exhibit/panels/particles_panel.h"
#include "exhibit/panels/scratch_panel.h"
#include "exhibit/panels/servo_rows.h"
#include "exhibit/panels/swing_panel.h"
#include "exhibit/scan/scan_subject.h"
#include "exhibit/words/guidance.h"
#include "scene/samples/adjusted_set.h"
#include "scene/shared/shared_blocks.h"
#include "servo/live_picture.h"
#include "support/particles/particle_sets.h"
#include "support/places.h"
#include "support/samples/tapped_sample.h"

namespace afm::exhibit {

render::Banner full_banner(const Phrases& phrases, render::Banner banner) {
  const Controls mouse{.hand = HandControls::Mouse, .pointer = Pointer::Mouse};
  for (const Hint hint : core::kEnumerators<Hint>) {
    const std::string text = step_text(phrases, hint, mouse);
    if (text.size() > banner.guidance.size()) banner.guidance = text;
  }
  banner.state_word = phrases[Phrase::StateReleasing];
  banner.state_color = {0.70F, 0.74F, 0.81F};
  banner.warning = phrases[Phrase::NotRealTime];
  scene::TipState tip;
  tip.active.scale.hand_m_per_m = 7e5;
  tip.active.scale.hand_n_per_n = 1.5e8;
  tip.safety.force_cap_n = 2.0;
  tip.safety.slew_limit_n_per_s = 20.0;
  scene::ServoTiming timing;
  timing.rate_hz = 1000.0;
  timing.ticks = 61222;
  timing.missed = 12;
  timing.wake_us[999] = 61222;
  timing.wake_max_us = 1000;
  scene::SharedDevice device;
  device.name = scene::to_name("simulated hand");
  banner.scale += "\n";
  for (const render::DataRow& row : servo_rows(tip, timing, device, phrases)) {
    banner.scale += fmt::format("{}: {} ({})     ", row.name, row.value, row.source);
  }
  return banner;
}

render::ControlPanel full_parameters(const Stage& stage) {
  const curves::LiveParameters gold(
      curves::make_sample_model(curves::ContactSetup{stage.materials.materials[1], {}, {}}).value());
  return parameter_panel(gold, stage.phrases().word("Silicon nitride"), ChangeState::Waiting, stage.phrases(),
                         "NVIDIA GeForce RTX 4090 Laptop GPU");
}

LiveScan full_scan(const Stage& stage) {
  const auto gold = curves::make_sample_model(curves::ContactSetup{stage.materials.materials[1], {}, {}});
  LiveScan scan(scan_subject(stage.wall_scene, 1, gold.value()));
  scan.step(ScanRow::Rate, 3);
  while (scan.row() < LiveScan::kPixels / 2) scan.advance(LiveScan::kMostCatchUpS);
  return scan;
}

LiveScan full_tapped_scan(const Stage& stage) {
  LiveScan scan(scan_subject(stage.wall_scene, 1, test::tapped_sample()));
  scan.step(ScanRow::FreeAmplitude, -1);
  scan.step(ScanRow::DriveFrequency, 1);
  while (scan.row() < LiveScan::kPixels / 32) scan.advance(LiveScan::kMostCatchUpS);
  return scan;
}

render::ForcePanel full_friction_loop(physics::FrictionLaw law, const Phrases& phrases) {
  FrictionHistory history;
  scene::TipSample sample;
  sample.phase = physics::Phase::Attached;
  for (int i = 0; i < 1300; ++i) {
    const int phase = i % 400;
    sample.surface.xy_m = {1e-9 * (phase < 200 ? phase : 400 - phase), 0.0};
    sample.lateral_force_n = {phase < 200 ? -123.4e-9 : 123.4e-9, 0.0};
    history.add(sample);
  }
  physics::FrictionParameters friction;
  friction.law = law;
  friction.period = physics::Length(0.5e-9);
  return friction_panel(history, friction, phrases);
}

render::ForcePanel full_dial(const Phrases& phrases) {
  static const curves::SampleModel sample = test::tapped_sample();
  scene::TipState tip;
  tip.tip.z_m = 17.4e-9;
  tip.swing = {.amplitude_m = 16e-9, .phase_rad = 2.0};
  return SwingDial().panel(sample, tip, phrases);
}

// Picture of the last particle, with the longest numbers.
servo::PictureNow old_picture(const scene::ParticleSet& set) {
  return {.level = 1,
          .known = std::vector<servo::Known>(set.particles.size(), servo::Known::Computed),
          .particle = set.particles.size() - 1,
          .age_s = 9999.0,
          .doubt_m = 123.4e-9,
          .all_measured = false,
          .looks = 99,
          .newest = {.particle = set.particles.size() - 1, .lines = 33, .off_m = 123.4e-9}};
}

std::vector<render::DataPanel> full_particles(const Phrases& phrases) {
  std::vector<render::DataPanel> panels;
  for (const char* name : {"gold-row", "latex-letter"}) {
    scene::ParticleSet set = test::particle_set(name);
    set.setup.species.front().sticks = true;
    const std::vector<scene::ParticlePage> pages = test::start_pages(set), formed = test::formed_pages(set);
    const std::vector<scene::PushLimits> limits = scene::push_limits(set);
    for (const physics::PushState state : core::kEnumerators<physics::PushState>) {
      scene::TipPush push = test::push_of(set, set.particles.size() - 1, state);
      push.softened_sideways = 123.4;
      push.strokes = scene::kMostStrokes;
      scene::TipPush changed = push;
      changed.settings = {.law = 4, .lever = 4, .tip = 4, .medium = 1, .level = 3};
      for (const physics::ParticleLawText& law : physics::kParticleLaws) {
        set.setup.species.front().law = law.law;
        for (const scene::TaskState task : core::kEnumerators<scene::TaskState>) {
          const scene::TaskScore score{.time_s = 9999.0,
                                       .rms_m = 123.4e-9,
                                       .work_j = 123.4e-18,
                                       .largest_lateral_n = 123.4e-9,
                                       .strokes = 999,
                                       .losses = 999,
                                       .undos = 999,
                                       .guided = 999,
                                       .state = task,
                                       .truth = 1};
          const scene::PlannedPush plan{
              .to_m = {0.0, 123.4e-9}, .particle = static_cast<std::int32_t>(set.particles.size()) - 1, .guided = 1};
          const servo::PictureNow picture = old_picture(set);
          for (const auto& lie : {pages, formed}) {
            panels.push_back(
                particles_panel({.set = &set, .pages = lie, .push = changed, .score = score, .plan = plan}, phrases));
            panels.push_back(particles_panel(
                {.set = &set, .pages = lie, .push = changed, .score = score, .limits = &limits}, phrases));
            if (state != physics::PushState::Several) continue;
            panels.push_back(particles_panel({.set = &set,
                                              .pages = lie,
                                              .push = push,
                                              .score = score,
                                              .plan = plan,
                                              .picture = &picture,
                                              .look_load_n = 123.4e-9},
                                             phrases));
          }
        }
      }
    }
    set.targets.clear();
    panels.push_back(particles_panel({.set = &set, .push = {.strokes = scene::kMostStrokes}}, phrases));
    panels.push_back(particles_panel({.set = &set}, phrases));
  }
  const scene::ParticleSet soft = test::particle_set("scratch-pmma");
  for (const physics::PushState state :
       {physics::PushState::Free, physics::PushState::Holds, physics::PushState::Slides}) {
    panels.push_back(scratch_panel({.set = &soft,
                                    .push = {.apex_m = {0.0, 0.0, -12.34e-9},
                                             .lateral_n = {123.4e-9, 0.0},
                                             .lift_n = 123.4e-9,
                                             .softened_sideways = 12.3,
                                             .state = state,
                                             .met = 1,
                                             .strokes = scene::kMostStrokes,
                                             .rise_m = 123.4e-9,
                                             .fastest_hand_m_per_s = 0.1234}},
                                   phrases));
  }
  const scene::ParticleSet ink = test::particle_set("write-ink");
  for (const physics::PushState state : {physics::PushState::Free, physics::PushState::Slides}) {
    panels.push_back(
        ink_panel({.set = &ink,
                   .push = {.lift_n = -18.34e-9,
                            .softened_upwards = 12.3,
                            .state = state,
                            .met = 1,
                            .strokes = scene::kMostStrokes,
                            .ink = {.covered_m2 = 2.744e-12, .flowed_s = 123.4, .speed_m_per_s = 1.234e-7}}},
                  phrases));
  }
  // under the title of every set of the program
  for (const auto& file : std::filesystem::directory_iterator(support::source("assets/particles"))) {
    render::DataPanel titled = panels.back();
    titled.title = phrases.word(test::particle_set(file.path().stem().string()).title);
    panels.push_back(std::move(titled));
  }
  return panels;
}

std::vector<LessonPrompt> full_prompts(const Phrases& phrases) {
  LessonPrompt consent;
  consent.wants = LessonPrompt::Wants::Answer;
  consent.title = phrases[Phrase::AllKeys];
  consent.words = phrases[Phrase::LessonConsent];
  consent.progress =
      phrases.text<Phrase::LessonStep>("12", "12") + " \u00b7 " + phrases.text<Phrase::LessonPractice>("12", "12");
  consent.answers = {phrases[Phrase::LessonConsentYes], phrases[Phrase::LessonConsentNo]};
  LessonPrompt draw = consent;
  draw.words = phrases[Phrase::LessonBreak];
  draw.hint = phrases[Phrase::DrawPart1];
  draw.answers.clear();
  for (std::size_t i = 0; i < 5; ++i) draw.answers.push_back(phrases[after(Phrase::DrawShape1, i)]);
  LessonPrompt scale = consent;
  scale.answers = answers_of(Questionnaire::Tlx, phrases);
  return {consent, draw, scale};
}

}  // namespace afm::exhibit
