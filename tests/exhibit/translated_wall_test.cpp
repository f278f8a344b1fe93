// SPDX-License-Identifier: Apache-2.0
// That no word of wall or report stays in the code: in a language that gives every vowel an accent, none without one is
// left.
// Invariant: every word of wall and report is in the phrase files
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/live/view_keys.h"
#include "app/options/dynamic_resolution.h"
#include "core/enumerators.h"
#include "curves/live_parameters.h"
#include "exhibit/frame/calibration.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/frame_builder.h"
#include "exhibit/lesson/instructor_page.h"
#include "exhibit/panels/data_panel.h"
#include "exhibit/panels/depth_report.h"
#include "exhibit/panels/parameter_panel.h"
#include "exhibit/panels/servo_rows.h"
#include "exhibit/report/report.h"
#include "exhibit/words/guidance.h"
#include "full_panels.h"
#include "scene/shared/shared_blocks.h"
#include "support/phrases.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::exhibit {
namespace translated_wall_test {

// Names: of symbols (F_attr), units, laws, products and scheduling classes; and the number of a report without a run.
const std::set<std::string, std::less<>> kNames{"attr",  "ad",  "joc",      "fold",    "kPa",    "MPa",
                                                "GPa",   "hao", "paper",    "hertz",   "maugis", "SCHED",
                                                "OTHER", "nan", "TouchAFM", "llvmpipe"};

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

// Runs of three or more plain letters with a vowel: a letter next to one with an accent belongs to a longer word.
std::vector<std::string> plain_words(std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    bool accented = false;
    while (end < text.size() && (is_letter(text[end]) || static_cast<unsigned char>(text[end]) >= 0x80)) {
      accented = accented || static_cast<unsigned char>(text[end]) >= 0x80;
      ++end;
    }
    const std::string word(text.substr(i, end - i));
    const bool vowel = word.find_first_of("aeiouyAEIOUY") != std::string::npos;
    if (word.size() > 2 && vowel && !accented && !kNames.contains(word)) words.push_back(word);
    i = std::max(end, i + 1);
  }
  return words;
}

class TranslatedWall : public ::testing::Test {
 protected:
  void SetUp() override {
    ExhibitFiles files;
    files.assets_dir = support::source("assets");
    files.guidance = folder_.write("pseudo.toml", test::pseudo_language());
    files.shown = {"mica", "gold", "si3n4", "mica-air", "polystyrene-air", "pdms-air"};
    auto stage = load_exhibit(files);
    ASSERT_TRUE(stage) << stage.error().message;
    stage_.emplace(std::move(*stage));
    for (const scene::MaterialEntry& entry : stage_->materials.materials) {
      models_.push_back(curves::make_sample_model(curves::ContactSetup{entry, {}, {}}).value());
    }
  }

  void check(const std::string& text) {
    ++checked_;
    for (const std::string& word : plain_words(text)) ADD_FAILURE() << "\"" << word << "\" is left in: " << text;
  }
  void check(const render::DataPanel& panel) {
    check(panel.title);
    check(panel.subtitle);
    for (const render::DataRow& row : panel.rows) check(row);
  }
  void check(const render::DataRow& row) {
    for (const std::string& text : {row.name, row.value, row.source}) check(text);
  }
  void check(const render::ControlPanel& panel) {
    check(panel.status);
    for (const std::string& text : panel.buttons) check(text);
    for (const std::string& text : panel.notes) check(text);
    for (const render::ControlRow& row : panel.rows) check(row.name + " " + row.value);
  }
  void check(const render::ForcePanel& panel) {
    for (const std::string& text : {panel.title, panel.stage, panel.words.approach, panel.words.retract}) check(text);
    for (const render::PlotCurve& curve : panel.curves) check(curve.label);
    for (const render::PlotMarker& marker : panel.markers) check(marker.label);
  }
  void check(const render::FrameState& frame) {
    for (const std::string& text : {frame.panels.banner.content.guidance, frame.panels.banner.content.state_word,
                                    frame.panels.banner.content.scale, frame.panels.banner.content.warning}) {
      check(text);
    }
    check(frame.panels.force.content);
    check(frame.panels.data.content);
    for (const render::Label& label : frame.labels) check(label.text);
  }
  const Phrases& phrases() const { return stage_->phrases(); }

  const support::ScratchFolder folder_;
  std::optional<Stage> stage_;
  std::vector<curves::SampleModel> models_;
  std::size_t checked_ = 0;
};

TEST_F(TranslatedWall, HasNoEnglishWordInAnyStateOfTheScene) {
  const FrameBuilder frames(stage_->wall_scene, models_, stage_->eyes);
  const std::vector<CycleCurve> curves(models_.size(), CycleCurve::from({{20.0, 0.0}, {-2.0, 0.3}, {20.0, 0.0}}));
  Moment moment;
  moment.curves = curves;
  check(frames.build(moment));
  for (const CycleResult& result : {CycleResult{"Mica", "dmt", true, 1e-9, 2e-9, 3e-9, 4e-9},
                                    CycleResult{"Gold 0.4 N/m", "dmt", false, 0, 0, 0, 0}}) {
    moment.results.push_back(result);
  }
  for (std::size_t material = 0; material < models_.size(); ++material) {
    moment.wall.material = material;
    for (const auto piece : {Centerpiece::Instrument, Centerpiece::Plot, Centerpiece::Analogy}) {
      moment.wall.centerpiece = piece;
      check(frames.build(moment));
    }
  }
  moment.wall.centerpiece = Centerpiece::Journey;
  for (double orders = 0.0; orders <= kJourneyOrders; orders += 0.5) {
    moment.wall.journey_orders = orders;
    check(frames.build(moment));
  }
  moment.wall.centerpiece = Centerpiece::Instrument;
  moment.slow_motion = 100.0;
  for (const scene::ServoState state : core::kEnumerators<scene::ServoState>) {
    moment.servo_state = state;
    for (const auto phase : {physics::Phase::WaitForLift, physics::Phase::Free, physics::Phase::Attached}) {
      moment.phase = phase;
      for (const double z_m : {-1e-9, 1e-9, 1e-6}) {
        for (const bool retracting : {false, true}) {
          moment.wall.tip.z_m = z_m;
          moment.retracting = retracting;
          check(frames.build(moment));
        }
      }
    }
  }
  EXPECT_GT(checked_, 3000U);
}

TEST_F(TranslatedWall, HasNoEnglishWordInWhatIsSaid) {
  scene::TipState tip;
  tip.material = 0;
  for (const HandControls hand : core::kEnumerators<HandControls>) {
    for (const Pointer pointer : core::kEnumerators<Pointer>) {
      for (const Hint hint : core::kEnumerators<Hint>) check(step_text(phrases(), hint, {hand, pointer}));
    }
  }
  for (const scene::FaultText& fault : scene::kFaultTexts) {
    tip.fault = fault.code;
    check(guidance_line(phrases(), Hint::Lift, tip, {}));
  }
  for (const Note note : core::kEnumerators<Note>) check(note_text(phrases(), note));
}

TEST_F(TranslatedWall, HasNoEnglishWordOnItsPanels) {
  for (const bool mouse : {false, true}) {
    check(app::key_list(mouse ? app::HandSource::Mouse : app::HandSource::Device, !mouse, phrases()));
  }
  for (const curves::SampleModel& model : models_) {
    const curves::LiveParameters parameters(model);
    for (const ChangeState state : core::kEnumerators<ChangeState>) {
      check(parameter_panel(parameters, "", state, phrases()));
    }
    render::ForcePanel plot;
    add_prediction(parameters, phrases(), plot);
    check(plot);
  }
  curves::LiveParameters refused(models_.front());
  while (refused.refusal().empty()) refused.step(curves::LiveParameters::Row::TipRadius, 1);
  check(parameter_panel(refused, "", ChangeState::Applied, phrases()));
  for (const render::DataPanel& particles : full_particles(phrases())) check(particles);
  scene::TipState tip;
  tip.active.scale.hand_m_per_m = tip.active.scale.hand_n_per_n = 1.0;
  tip.safety.motor_heat = 0.9;
  tip.dead_man = 1;
  scene::ServoTiming timing;
  timing.ticks = 1;
  scene::SharedDevice device;
  device.name = scene::to_name("simulated hand");
  for (const scene::ScaleModeText& mode : scene::kScaleModes) {
    tip.active.scale_mode = mode.mode;
    for (const render::DataRow& row : servo_rows(tip, timing, device, phrases())) check(row);
  }
  app::DynamicResolution quality(10.0, 4);
  check(quality.row(phrases()));
  for (int i = 0; i < 1000; ++i) quality.add(1000.0);
  check(quality.row(phrases()));
  for (const Relief relief : core::kEnumerators<Relief>) {
    check(depth_text(report_depth({.nearest_m = 1.0, .farthest_m = 10.0}, 2.5, 0.063, relief), phrases()));
  }
  for (const auto mode : {scene::StereoMode::Mono, scene::StereoMode::SideBySide}) {
    render::FrameState frame;
    show_calibration(stage_->screen, mode, 0.063, phrases(), frame);
    check(frame.panels.calibration.content.legend);
    check(frame.panels.calibration.content.ruler);
  }
}

TEST_F(TranslatedWall, HasNoEnglishWordOnTheInstructorsPage) {
  InstructorState state;
  for (const auto wants : core::kEnumerators<LessonPrompt::Wants>) {
    state.prompt.wants = wants;
    state.prompt.in_step = wants != LessonPrompt::Wants::Nothing;
    for (const scene::ServoState hand : core::kEnumerators<scene::ServoState>) {
      state.hand = hand;
      for (const bool asked : {false, true}) {
        state.hand_off = state.stop_asked = asked;
        state.judged = asked ? 4 : 0;
        const render::FrameState page = InstructorPage(16.0 / 9.0).frame(state, std::nullopt, phrases());
        check(page.panels.data.content);
        for (const render::Label& target : page.labels) check(target.text);
      }
    }
  }
  EXPECT_GT(checked_, 500U);
}

TEST_F(TranslatedWall, HasNoEnglishWordInItsReport) {
  exhibit::DemoResult result;
  result.haptic_device = "simulated hand";
  result.vulkan_device = "llvmpipe";
  exhibit::Measurement gold;
  gold.title = "Gold 0.1 N/m";
  gold.law = "paper";
  for (const bool recorded : {false, true}) {
    for (const bool jumps : {false, true}) {
      gold.recorded = recorded;
      gold.hysteretic = recorded || jumps;
      gold.snaps_in = gold.pulls_off = jumps;
      result.measurements.push_back(gold);
    }
  }
  std::string html = exhibit::report_html(result, {}, "", phrases());
  EXPECT_NE(html.find("<html lang=\"en\">"), std::string::npos);
  html.erase(0, html.find("</style>"));
  std::string text;
  bool in_tag = false;
  for (const char c : html) {
    in_tag = in_tag || c == '<';
    text += in_tag ? ' ' : c;
    in_tag = in_tag && c != '>';
  }
  check(text);
}

}  // namespace translated_wall_test
}  // namespace afm::exhibit
