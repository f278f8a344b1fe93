// SPDX-License-Identifier: Apache-2.0
// That nothing on the wall flashes more than three times a second (WCAG 2.3.1), however fast a tip chatters in and out
// of contact. Lever, cursor and curve move with the tip, which nothing may hold back.
// Invariant: nothing on the wall flashes more than three times a second, however fast the tip chatters
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <string>
#include <vector>

#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/frame_builder.h"
#include "exhibit/sound/narrator.h"
#include "exhibit/state/cycle_history.h"
#include "exhibit/words/guidance.h"
#include "exhibit/words/procedure.h"
#include "support/places.h"

namespace afm::exhibit {
namespace flashes_test {

constexpr std::int64_t kMs = 1'000'000;
constexpr int kSeconds = 12, kFrameMs = 17;

class TickClock final : public core::Clock {
 public:
  std::int64_t now_ns() const noexcept override { return now; }
  std::int64_t now = 1'000'000'000;
};

// When each element of the picture changed.
class Changes {
 public:
  void see(const std::string& element, std::string value, std::int64_t now_ns) {
    const auto [entry, first] = shown_.try_emplace(element, value);
    if (first || entry->second == value) return;
    entry->second = std::move(value);
    changed_ns_[element].push_back(now_ns);
  }
  // The most within a second.
  std::size_t most(const std::string& element) const {
    const auto found = changed_ns_.find(element);
    if (found == changed_ns_.end()) return 0;
    std::size_t most = 0;
    for (auto from = found->second.begin(); from != found->second.end(); ++from) {
      const auto to = std::lower_bound(from, found->second.end(), *from + 1000 * kMs);
      most = std::max(most, static_cast<std::size_t>(to - from));
    }
    return most;
  }
  std::vector<std::string> elements() const {
    std::vector<std::string> names;
    for (const auto& [name, value] : shown_) names.push_back(name);
    return names;
  }

 private:
  std::map<std::string, std::string> shown_;
  std::map<std::string, std::vector<std::int64_t>> changed_ns_;
};

class Flashes : public ::testing::Test {
 protected:
  Flashes() {
    ExhibitFiles files;
    files.assets_dir = support::source("assets");
    stage_.emplace(load_exhibit(files).value());
    for (const scene::MaterialEntry& entry : stage_->materials.materials) {
      models_.push_back(curves::make_sample_model(curves::ContactSetup{entry, {}, {}}).value());
    }
  }

  // The wall, frame by frame, while the tip snaps in and lets go so many times a second.
  Changes chatter(double cycles_per_s) {
    TickClock clock;
    Narrator narrator(stage_->phrases(), stage_->titles(), clock, [](const Heard&) {}, [](const SpeechText&) {});
    CycleHistory cycles(models_.size());
    Procedure procedure;
    JumpCues cues;
    Changes changes;
    const FrameBuilder frames(stage_->wall_scene, models_, stage_->eyes);
    bool attached = false;
    for (int ms = 0; ms < 1000 * kSeconds; ++ms) {
      clock.now += kMs;
      tip_.time_ns = clock.now;
      const double turn = std::sin(6.283185 * cycles_per_s * ms * 1e-3);
      const bool now_attached = attached ? turn < 0.9 : turn < -0.9;
      move_tip(turn, now_attached);
      if (now_attached != attached) {
        scene::TipEvent event;
        event.kind = now_attached ? physics::EventKind::JumpToContact : physics::EventKind::JumpOffContact;
        event.time_ns = clock.now;
        event.material = 0;
        event.force_before_n = now_attached ? -2e-10 : -1.4e-9 - 1e-12 * ms;
        event.force_after_n = now_attached ? -4e-10 - 1e-12 * ms : 0.0;
        cycles.add(event);
        cues.add(event);
        narrator.heard(event);
      }
      attached = now_attached;
      const scene::TipSample sample = sample_of_tip(turn);
      cycles.add(sample);
      narrator.heard(sample);
      if (ms % kFrameMs == 0) look(frames.build(moment(cycles, cues, procedure)), narrator, changes);
    }
    return changes;
  }

 private:
  void move_tip(double turn, bool attached) {
    tip_.material = 0;
    tip_.realtime = 1;
    tip_.servo_state = scene::ServoState::Running;
    tip_.phase = attached ? physics::Phase::Attached : physics::Phase::Free;
    tip_.active.release_z_m = 14e-9;
    tip_.active.scale.hand_m_per_m = 0.05 / 14e-9;
    tip_.tip.z_m = 7e-9 * (0.9 + turn);
    tip_.tip.force_n = attached ? -1e-9 * (1.0 + turn) : 0.0;
    tip_.tip.deflection_m = tip_.tip.force_n / 0.1;
  }
  scene::TipSample sample_of_tip(double turn) const {
    scene::TipSample sample;
    sample.time_ns = tip_.time_ns;
    sample.tip = tip_.tip;
    sample.hand_height_m = 0.05 * (0.9 + turn);
    sample.servo_state = tip_.servo_state;
    sample.phase = tip_.phase;
    sample.material = tip_.material;
    return sample;
  }
  // Moment as made by the live window.
  Moment moment(const CycleHistory& cycles, const JumpCues& cues, Procedure& procedure) {
    const bool ascending = cycles.ascending() || (cycles.pressed() && tip_.tip.z_m > 0.0);
    hint_ = procedure.update(tip_, {ascending, cycles.pressed(), cycles.cycles()}, tip_.time_ns);
    Moment now = moment_of(tip_, cycles.ascending());
    now.curves = cycles.curves();
    now.guidance = guidance_line(stage_->phrases(), hint_, tip_, {});
    now.wall.cue = cues.at(tip_.time_ns);
    return now;
  }

  void look(const render::FrameState& frame, Narrator& narrator, Changes& changes) {
    const std::int64_t now_ns = tip_.time_ns;
    const auto see = [&](const std::string& element, std::string value) {
      changes.see(element, std::move(value), now_ns);
    };
    // a ring that becomes brighter is another one
    const float light = glm::dot(frame.contact.ring_color, glm::vec3(0.2126F, 0.7152F, 0.0722F));
    if (light > ring_light_ + 0.01F) ++rings_;
    ring_light_ = light;
    see("ring", std::to_string(rings_));
    see("shade", frame.contact.shade_radius_m > 0.0F ? "shown" : "");
    see("fog", std::to_string(frame.fog.fade));
    narrator.follow(tip_, {.hint = hint_, .guidance = frame.panels.banner.content.guidance, .scan_lines = {}});
    see("caption", narrator.caption());
    see("guidance", frame.panels.banner.content.guidance);
    see("state", frame.panels.banner.content.state_word);
    see("scale", frame.panels.banner.content.scale);
    see("warning", frame.panels.banner.content.warning);
    for (std::size_t i = 0; i < frame.labels.size(); ++i) {
      see("label " + std::to_string(i), frame.labels[i].text + (frame.labels[i].highlighted ? " marked" : ""));
    }
    see("word of the jump", frame.labels.back().text);
    for (std::size_t i = 0; i < frame.visible.size(); ++i) {
      see("node " + stage_->wall_scene.scene().nodes[i].name, std::to_string(frame.visible[i]));
    }
    see("highlighted", std::to_string(frame.highlighted.size()));
    see("data panel", frame.panels.data.content.title + frame.panels.data.content.subtitle);
    see("plot", frame.panels.force.content.title + std::to_string(frame.panels.force.content.markers.size()));
    see("curves", std::to_string(frame.panels.force.content.curves.size()));
    see("force panel", std::to_string(glm::length(frame.panels.force.placement.right_m)));
    see("data panel's place", std::to_string(glm::length(frame.panels.data.placement.right_m)));
    see("banner", std::to_string(glm::length(frame.panels.banner.placement.right_m)));
    see("stage", frame.panels.force.content.stage);
  }

 protected:
  std::optional<Stage> stage_;
  std::vector<curves::SampleModel> models_;
  scene::TipState tip_;
  Hint hint_ = Hint::ChooseSample;
  float ring_light_ = 0;
  int rings_ = 0;
};

TEST_F(Flashes, NothingChangesMoreThanThreeTimesASecondHoweverFastTheTipChatters) {
  for (const double cycles_per_s : {1.0, 3.0, 7.0, 20.0}) {
    const Changes changes = chatter(cycles_per_s);
    EXPECT_GT(changes.elements().size(), 40U);
    EXPECT_GT(changes.most("ring"), 0U) << cycles_per_s;
    EXPECT_GT(changes.most("caption"), 0U) << cycles_per_s;
    EXPECT_GT(changes.most("node probe-ghost"), 0U) << cycles_per_s;
    EXPECT_GT(changes.most("word of the jump"), 0U) << cycles_per_s;
    for (const std::string& element : changes.elements()) {
      if (element != "stage") {
        EXPECT_LE(changes.most(element), 3U) << element << ", " << cycles_per_s << " Hz";
      }
    }
  }
}

// The line that names the part of the cycle follows it at once. Its letters are too small for a flash: together they
// take less than 0.006 steradians.
TEST_F(Flashes, TheLineThatFollowsTheTipIsTooSmallForOne) {
  constexpr double kLargestSafeSr = 0.006, kLetterMm = 40.0, kMeanWidth = 0.6;  // fraction of a letter's height
  EXPECT_GT(chatter(20.0).most("stage"), 3U) << "or it needs no exception";
  const double distance_m = stage_->wall.viewers.front().sweet_spot.position_m.z;
  const double letter_m = kLetterMm * stage_->wall_scene.panel_millimetre_m();
  for (std::size_t i = 0; after(Phrase::StageLift, i) != after(Phrase::StageFree, 1); ++i) {
    const std::string& text = stage_->phrases()[after(Phrase::StageLift, i)];
    const double area_m2 = kMeanWidth * letter_m * letter_m * static_cast<double>(text.size());
    EXPECT_LT(area_m2 / (distance_m * distance_m), kLargestSafeSr) << text;
  }
}

}  // namespace flashes_test
}  // namespace afm::exhibit
