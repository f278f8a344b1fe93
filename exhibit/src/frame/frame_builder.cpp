// SPDX-License-Identifier: Apache-2.0
#include "exhibit/frame/frame_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <utility>

#include "core/enumerators.h"
#include "curves/plot_units.h"
#include "exhibit/models/marks_relief.h"
#include "exhibit/panels/data_panel.h"
#include "exhibit/panels/ink_panel.h"
#include "exhibit/panels/particles_panel.h"
#include "exhibit/panels/scratch_panel.h"
#include "exhibit/scan/scan_panels.h"
#include "exhibit/scan/scan_relief.h"
#include "exhibit/scan/scan_subject.h"
#include "exhibit/scenery/journey.h"
#include "exhibit/scenery/wall_scene.h"
#include "exhibit/words/guidance.h"
#include "exhibit/words/signed_text.h"
#include "haptics/scaling.h"
#include "panels/panel_conventions.h"
#include "physics/quantity_text.h"
#include "scene/samples/particle_set.h"

namespace afm::exhibit {

namespace {

using physics::format_quantity;

// Axes around the loop, in units of the pull's reach and strength.
constexpr double kAxisBelow = 0.42, kAxisAbove = 1.42;
constexpr double kPushShare = 0.4;  // deepest push, relative to the reach
constexpr double kHardlyPulled = 0.05;
constexpr const char* kApart = "     ";  // separator between two facts on a line

struct StateSign {
  render::StateShape shape;
  glm::vec3 color;
};

// Signs in the order of scene::ServoState, then one for a stopped force, the same as for no force.
const std::array<StateSign, 6> kStateSigns{{{render::StateShape::Square, {0.70F, 0.74F, 0.80F}},
                                            {render::StateShape::Triangle, {0.94F, 0.89F, 0.26F}},
                                            {render::StateShape::Circle, {0.34F, 0.85F, 0.60F}},
                                            {render::StateShape::Diamond, {0.90F, 0.62F, 0.0F}},
                                            {render::StateShape::Cross, {0.95F, 0.35F, 0.25F}},
                                            {render::StateShape::Square, {0.70F, 0.74F, 0.80F}}}};
static_assert(after(Phrase::StateOff, kStateSigns.size()) == Phrase::NotRealTime);

// Length shown by one metre of the wall, such as "33.1 nm".
std::string scale_text(double m_per_m) {
  std::string text = format_quantity(physics::Length(m_per_m), physics::kLengthUnits, 3);
  if (const std::size_t micro = text.find("um"); micro != std::string::npos) text.replace(micro, 1, "\u00b5");
  return text;
}

// Axes around the loops of all materials in front.
class Axes {
 public:
  void include(const curves::SampleModel& material) {
    const double reach_m = material.scaling.release_z_m();
    const double push_n = material.tables->attached.force(physics::Length(-kPushShare * reach_m)).si;
    reach_nm_ = std::max(reach_nm_, reach_m * curves::kNmPerM);
    pull_nn_ = std::max(pull_nn_, haptics::strongest_pull_n(*material.tables) * curves::kNnPerN);
    push_nn_ = std::max(push_nn_, push_n * curves::kNnPerN);
    a0_nm_ = std::max(a0_nm_, material.parameters.free_amplitude_m * curves::kNmPerM);
  }

  // The pull sets the range; if it is negligible, the push does.
  void apply(render::ForcePanel& panel) const {
    const bool pulled = pull_nn_ > kHardlyPulled * push_nn_;
    panel.place_min_nm = -kAxisBelow * reach_nm_;
    panel.place_max_nm = kAxisAbove * reach_nm_;
    panel.force_min_nn = pulled ? -kForceBelow * pull_nn_ : -kForceAbove * push_nn_;
    panel.force_max_nn = pulled ? kForceAbove * pull_nn_ : kForceBelow * push_nn_;
    if (!of_amplitude()) return;
    panel.words.force_axis = "A (nm)";
    panel.force_min_nn = 0.0;
    panel.force_max_nn = kAxisAbove * a0_nm_;
  }

  bool of_amplitude() const { return a0_nm_ > 0.0; }  // true in tapping mode

 private:
  double reach_nm_ = 1e-6, pull_nn_ = 1e-9, push_nn_ = 0.0, a0_nm_ = 0.0;
};

// Three forces that characterise a cycle: that of the law at the fold, felt just before the jump; the paper's F_attr
// just after it; and the pull-off.
std::vector<render::PlotMarker> jump_markers(const physics::CycleFigures& figures, const Phrases& phrases) {
  using Kind = render::PlotMarker::Kind;
  const double z_jtc_nm = figures.z_jtc.si * curves::kNmPerM, z_joc_nm = figures.z_joc.si * curves::kNmPerM;
  const double fold_nn = figures.force_before_jtc.si * curves::kNnPerN;
  const double after_nn = figures.force_after_jtc.si * curves::kNnPerN;
  const double pull_off_nn = figures.force_before_joc.si * curves::kNnPerN;
  std::vector<render::PlotMarker> markers{
      {Kind::VerticalLine, z_jtc_nm, phrases.number(fmt::format("Z_jtc {:.2f} nm", z_jtc_nm))},
      {Kind::VerticalLine, z_joc_nm, phrases.number(fmt::format("Z_joc {:.2f} nm", z_joc_nm))},
      {Kind::HorizontalLine, after_nn, phrases.number(fmt::format("F_attr {:.3f} nN", std::abs(after_nn)))},
      {Kind::HorizontalLine, pull_off_nn, phrases.number(fmt::format("F_ad {:.3f} nN", std::abs(pull_off_nn)))}};
  if (fold_nn != 0.0) {
    markers.push_back(
        {Kind::HorizontalLine, fold_nn, phrases.number(fmt::format("F_fold {:.3f} nN", std::abs(fold_nn)))});
  }
  return markers;
}

// Moment as it is drawn: without a force the tip rests on the sample until it is lifted, though the hand is deeper.
WallState drawn_state(const Moment& moment) {
  WallState drawn = moment.wall;
  if (moment.phase == physics::Phase::WaitForLift) drawn.tip.z_m = std::max(drawn.tip.z_m, drawn.tip.deflection_m);
  return drawn;
}

}  // namespace

glm::vec3 curve_color(std::size_t material) {
  // after M. Okabe and K. Ito, moved apart for each kind of dichromat
  static constexpr std::array<glm::vec3, 7> kColors{{{0.34F, 0.71F, 0.91F},
                                                     {0.90F, 0.62F, 0.00F},
                                                     {0.03F, 0.95F, 0.68F},
                                                     {0.70F, 0.36F, 0.54F},
                                                     {0.97F, 0.97F, 0.20F},
                                                     {0.10F, 0.40F, 0.72F},
                                                     {0.80F, 0.25F, 0.05F}}};
  return kColors[material % kColors.size()];
}

Phrase stage_of_cycle(const Moment& moment, double z_jtc_m) {
  using enum Phrase;
  if (moment.phase == physics::Phase::WaitForLift) return StageLift;
  if (moment.phase == physics::Phase::Free) {
    if (moment.retracting) return StageFree;
    return moment.wall.tip.z_m < 2.0 * z_jtc_m ? StageNear : StageApproach;
  }
  if (!moment.retracting) return moment.wall.tip.z_m > 0.0 ? StageSnapIn : StagePress;
  return moment.wall.tip.z_m > 0.0 ? StageAdhesion : StageRetract;
}

// Amplitude of the swing, its phase and its state, instead of the force.
void show_swing(const Moment& moment, const curves::SampleModel& material, const Phrases& phrases,
                render::ForcePanel& panel) {
  using Kind = render::PlotMarker::Kind;
  const double a0_nm = material.parameters.free_amplitude_m * curves::kNmPerM;
  panel.title = phrases[material.tables->taps ? Phrase::PlotTitleDirect : Phrase::PlotTitleTapping];
  const physics::CycleFigures& figures = material.figures();
  if (figures.hysteretic) {
    for (const auto& [arrow, z] : {std::pair{"\u2193", figures.z_jtc}, {"\u2191", figures.z_joc}}) {
      const double z_nm = z.si * curves::kNmPerM;
      panel.markers.push_back({Kind::VerticalLine, z_nm, phrases.number(fmt::format("Z {} {:.2f} nm", arrow, z_nm))});
    }
  }
  if (moment.phase == physics::Phase::WaitForLift) {
    panel.stage = phrases[Phrase::StageLift];
    return;
  }
  const double a_nm = moment.wall.swing.amplitude_m * curves::kNmPerM;
  const bool free = std::abs(a_nm / a0_nm - 1.0) < kFreeSwing;
  const bool repelled = moment.phase == physics::Phase::Attached;
  const std::string amplitude = phrases.number(fmt::format("{:.2f} nm", a_nm));
  panel.stage = phrases[repelled ? Phrase::SwingRepulsive : free ? Phrase::SwingFree : Phrase::SwingAttractive];
  panel.live = amplitude;
  panel.figures = {{phrases[Phrase::SwingAmplitude], amplitude, ""},
                   {phrases[Phrase::SwingPhase],
                    phrases.number(fmt::format("{:.1f}\u00b0", glm::degrees(moment.wall.swing.phase_rad))), ""},
                   {phrases[Phrase::SwingState], panel.stage, ""}};
  panel.cursor = render::PlotPoint{moment.wall.tip.z_m * curves::kNmPerM, a_nm};
}

FrameBuilder::FrameBuilder(const WallScene& wall_scene, const std::vector<curves::SampleModel>& materials,
                           const std::array<scene::EyeView, 2>& eyes)
    : wall_scene_(&wall_scene), phrases_(&wall_scene.phrases()), materials_(&materials), eyes_(eyes) {}

render::FrameState FrameBuilder::build(const Moment& moment) const {
  render::FrameState frame;
  frame.eyes = eyes_;
  wall_scene_->update(drawn_state(moment), frame);
  frame.panels.force.content = force_panel(moment);
  if (moment.scan != nullptr && moment.wall.material) {
    const std::string& title = (*materials_)[*moment.wall.material].setup.material.title;
    frame.panels.image.content = image_panel(*moment.scan, phrases_->word(title), *phrases_);
    wall_scene_->lay_on_sample(relief_of(*moment.scan), moment.wall, frame);
  } else if (moment.wall.false_colours && moment.wall.material) {
    wall_scene_->lay_on_sample(sample_in_colours(*moment.wall.material), moment.wall, frame);
  } else if (moment.wall.particles != nullptr && !moment.wall.particles->tiles.empty()) {
    wall_scene_->lay_marks(marks_of(*moment.wall.particles), moment.wall, frame);
  }
  if (moment.wall.centerpiece == Centerpiece::Plot) {
    frame.panels.data.content = results_panel(moment.results, *phrases_);
  } else if (moment.wall.material) {
    frame.panels.data.content = data_panel((*materials_)[*moment.wall.material], moment.wall.tip, *phrases_);
  } else {
    frame.panels.data.content = {
        .title = (*phrases_)[Phrase::NoSample],
        .subtitle = no_sample_advice(*phrases_, moment.by_wand ? Pointer::Wand : Pointer::Mouse),
        .rows = {}};
  }
  if (moment.wall.particles != nullptr) {
    const ParticlesNow& now = *moment.wall.particles;
    const auto panel = now.set->soft ? scratch_panel : now.set->ink ? ink_panel : particles_panel;
    frame.panels.particles.content = panel(now, *phrases_);
  }
  frame.panels.banner.content = banner(moment);
  return frame;
}

const HeightRelief& FrameBuilder::marks_of(const ParticlesNow& now) const {
  if (!marks_ || marks_->marks != now.marks) {
    marks_ = {now.marks, marks_relief(now.tiles, marks_scale(*now.set))};
  }
  return marks_->relief;
}

// Relief of the sample in colours, sampled again only for another sample or size.
const HeightRelief& FrameBuilder::sample_in_colours(std::size_t material) const {
  const curves::SampleModel& model = (*materials_)[material];
  const double release_z_m = model.scaling.release_z_m();
  if (!coloured_ || coloured_->material != material || coloured_->release_z_m != release_z_m) {
    coloured_ = {material, release_z_m, relief_of(scan_subject(*wall_scene_, material, model))};
  }
  return coloured_->relief;
}

render::ForcePanel FrameBuilder::force_panel(const Moment& moment) const {
  const Phrases& phrases = *phrases_;
  render::ForcePanel panel;
  panel.title = phrases[Phrase::PlotTitle];
  panel.words = {.approach = phrases[Phrase::PlotApproach],
                 .retract = phrases[Phrase::PlotRetract],
                 .decimal_mark = phrases.decimal_mark()};
  Axes axes;
  for (std::size_t i = 0; i < materials_->size(); ++i) {
    const bool in_front =
        moment.wall.centerpiece == Centerpiece::Plot || !moment.wall.material || moment.wall.material == i;
    if (!in_front) continue;  // curve whose forces would exceed the axes
    axes.include((*materials_)[i]);
    if (i >= moment.curves.size() || moment.curves[i].empty()) continue;
    panel.curves.push_back(moment.curves[i].plot(phrases.word((*materials_)[i].setup.material.title), curve_color(i)));
    panel.curves.back().filled = moment.wall.material == i;
  }
  axes.apply(panel);
  if (axes.of_amplitude()) panel.title = phrases[Phrase::PlotTitleTapping];
  if (moment.wall.centerpiece == Centerpiece::Plot) {
    panel.title = phrases[Phrase::PlotTitleAll];
    panel.stage = "";
    return panel;
  }
  if (!moment.wall.material) return panel;

  const curves::SampleModel& material = (*materials_)[*moment.wall.material];
  if (material.taps()) {
    show_swing(moment, material, phrases, panel);
    return panel;
  }
  const physics::CycleFigures& figures = material.figures();
  if (figures.hysteretic) panel.markers = jump_markers(figures, phrases);
  panel.stage = phrases[stage_of_cycle(moment, figures.z_jtc.si)];
  panel.live = phrases.number(force_text(moment.wall.tip.force_n));
  if (moment.phase != physics::Phase::WaitForLift) {
    panel.cursor = render::PlotPoint{moment.wall.tip.z_m * curves::kNmPerM, moment.wall.tip.force_n * curves::kNnPerN};
  }
  return panel;
}

render::Banner FrameBuilder::banner(const Moment& moment) const {
  const Phrases& phrases = *phrases_;
  const Phrase word = state_phrase(moment.servo_state, moment.stopped);
  const StateSign& sign = kStateSigns[static_cast<std::size_t>(word) - static_cast<std::size_t>(Phrase::StateOff)];
  render::Banner banner;
  banner.guidance = moment.guidance;
  banner.state_word = phrases[word];
  banner.state_shape = sign.shape;
  banner.state_color = sign.color;
  if (!moment.realtime) banner.warning = phrases[Phrase::NotRealTime];
  if (moment.slow_motion > 1.0) {
    banner.warning = phrases.text<Phrase::SlowMotion>(fmt::format("{:.3g}", moment.slow_motion)) +
                     (moment.realtime ? "" : ", " + phrases[Phrase::NotRealTime]);
  }
  if (moment.wall.centerpiece == Centerpiece::Journey) {
    const double orders = moment.wall.journey_orders;
    banner.guidance = phrases.text<Phrase::Journey>(phrases[journey_place(orders)]);
    banner.scale = phrases.text<Phrase::TrueScale>(scale_text(wall_scene_->journey_m_per_m(orders)));
    return banner;
  }
  const DrawnScale scale = wall_scene_->drawn_scale(moment.wall.material.value_or(0), moment.wall.release_z_m);
  banner.scale = fmt::format(
      "{1}{0}{2}{0}{3}{0}{4}", kApart, phrases.text<Phrase::SampleScale>(scale_text(scale.sample_m_per_m)),
      phrases.text<Phrase::LeverScale>(scale_text(scale.lever_m_per_m)),
      phrases.text<Phrase::TipScale>(scale_text(scale.tip_m_per_m)),
      phrases.text<Phrase::DeflectionScale>(fmt::format("{:.0f}", scale.lever_m_per_m / scale.sample_m_per_m)));
  // on a separate line
  for (const render::DataRow& row : moment.servo) {
    banner.scale +=
        fmt::format("{}{}: {} ({})", &row == &moment.servo.front() ? "\n" : kApart, row.name, row.value, row.source);
  }
  return banner;
}

}  // namespace afm::exhibit
