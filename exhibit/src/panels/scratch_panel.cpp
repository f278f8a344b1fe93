// SPDX-License-Identifier: Apache-2.0
#include "exhibit/panels/scratch_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/enumerators.h"
#include "panels/panel_conventions.h"
#include "panels/sourced_rows.h"
#include "physics/manipulation/marking.h"
#include "physics/quantity_text.h"
#include "scene/samples/particle_set.h"
#include "scene/samples/scratch_run.h"

namespace afm::exhibit {

namespace {

using physics::Force;
using physics::Length;
using physics::PushState;

static_assert(after(Phrase::SoftFree, core::index_of(PushState::Slides)) == Phrase::SoftMarks);

constexpr double kRaisedM = 1e-10;       // height beyond which the panel reports that the hand is too fast
constexpr double kAroundCurve = 1.1;     // axes relative to the shown range
constexpr double kLeastPlottedNn = 1.0;  // push at the top of the axis before the first scratch

class ScratchRows : private SourcedRows {
 public:
  using SourcedRows::SourcedRows;

  std::vector<render::DataRow> take() {
    add_contact();
    add_groove();
    add_speed();
    add_numbers();
    return std::move(rows_);
  }

 private:
  Force load() const { return Force(std::max(0.0, now_.push.lift_n)); }

  void add_contact() {
    const scene::TipPush& push = now_.push;
    const PushState state = std::min(push.state, PushState::Slides);
    add(Phrase::PushStateName, phrases_[after(Phrase::SoftFree, core::index_of(state))], "");
    add(Phrase::SoftLoad, text(load(), physics::kForceUnits), phrases_[Phrase::PushLateralOn]);
    const bool on = state != PushState::Free;
    add(Phrase::SoftDepth, text(Length(on ? std::max(0.0, -push.apex_m[2]) : 0.0), physics::kLengthUnits),
        phrases_[Phrase::SoftDepthOf]);
    const Force sideways(std::hypot(push.lateral_n[0], push.lateral_n[1]));
    add(Phrase::PushLateral, text(sideways, physics::kForceUnits),
        load().si > 0.0 ? phrases_.text<Phrase::SoftSideways>(phrases_.number(fmt::format("{:.2f}", sideways / load())))
                        : phrases_[Phrase::PushLateralOn]);
  }

  void add_groove() {
    if (!(load().si > 0.0)) return;
    const physics::SoftSurface& surface = now_.set->soft->surface;
    add(Phrase::SoftGroove, text(2.0 * physics::groove_radius(surface, load()), physics::kLengthUnits),
        phrases_.text<Phrase::SoftGrooveOf>(
            text(physics::groove_depth(now_.set->setup.tip, surface, load()), physics::kLengthUnits)));
  }

  void add_speed() {
    const scene::TipPush& push = now_.push;
    if (!(push.fastest_hand_m_per_s > 0.0)) return;  // limit not yet reported by the servo
    add(Phrase::SoftSpeed, text(physics::Velocity(push.fastest_hand_m_per_s), physics::kVelocityUnits),
        push.rise_m > kRaisedM ? phrases_.text<Phrase::SoftFast>(text(Length(push.rise_m), physics::kLengthUnits))
                               : phrases_[Phrase::SoftSlow]);
  }

  void add_numbers() {
    add_sourced(Phrase::SoftHardness, text(now_.set->soft->surface.hardness, physics::kPressureUnits), "hardness");
    add_sourced(Phrase::LeverSideways, text(now_.set->setup.springs.lateral, physics::kStiffnessUnits),
                "lateral_spring");
    add_softened(now_.push.softened_sideways);
  }
};

}  // namespace

render::DataPanel scratch_panel(const ParticlesNow& now, const Phrases& phrases) {
  return {.title = phrases.word(now.set->title),
          .subtitle = phrases.text<Phrase::SoftTakeBack>(fmt::format("{}", now.push.strokes)),
          .rows = ScratchRows(now, phrases).take(),
          .details = false};
}

void leave_law_out(const ParticlesNow& now, const Phrases& phrases, render::ForcePanel& plot) {
  std::erase_if(plot.curves, [](const render::PlotCurve& curve) { return curve.faded; });
  plot.markers.clear();
  plot.stage.clear();
  double deepest_nm = 0.0, highest_nm = 0.0, least_nn = 0.0, most_nn = kLeastPlottedNn;
  const auto include = [&](const render::PlotPoint& point) {
    deepest_nm = std::min(deepest_nm, point.place_nm);
    least_nn = std::min(least_nn, point.force_nn);
    most_nn = std::max(most_nn, point.force_nn);
    if (point.force_nn != 0.0)
      highest_nm = std::max(highest_nm, point.place_nm);  // highest place at which liquid holds the tip
  };
  for (render::PlotCurve& curve : plot.curves) {
    curve.label = phrases.word(now.set->title);
    std::for_each(curve.approach.begin(), curve.approach.end(), include);
    std::for_each(curve.retract.begin(), curve.retract.end(), include);
  }
  if (plot.cursor) include(*plot.cursor);
  plot.place_min_nm = std::min(plot.place_min_nm, kAroundCurve * deepest_nm);
  plot.place_max_nm = std::max(plot.place_max_nm, kAroundCurve * highest_nm);
  plot.force_min_nn = std::min(kAroundCurve * least_nn, (1.0 - kAroundCurve) * most_nn);
  plot.force_max_nn = kAroundCurve * most_nn;
}

}  // namespace afm::exhibit
