// SPDX-License-Identifier: Apache-2.0
#include "exhibit/panels/ink_panel.h"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "panels/sourced_rows.h"
#include "physics/manipulation/ink.h"
#include "physics/quantity_text.h"
#include "scene/samples/ink_run.h"
#include "scene/samples/particle_set.h"
#include "scene/shared/soft_blocks.h"

namespace afm::exhibit {

namespace {

using physics::Length;
using physics::Velocity;

constexpr double kRestsMPerS = 1e-9;  // speed below which the tip makes a dot
constexpr double kSquareNm = 1e-18, kSquareUm = 1e-12;
constexpr double kLeastSquareUm = 0.1;  // area below which the unit is square nanometres

class InkRows : private SourcedRows {
 public:
  using SourcedRows::SourcedRows;

  std::vector<render::DataRow> take() {
    add_contact();
    add_writing();
    add_numbers();
    return std::move(rows_);
  }

 private:
  const scene::InkSample& ink() const { return *now_.set->ink; }

  std::string area(double m2) const {
    return phrases_.number(m2 < kLeastSquareUm * kSquareUm ? fmt::format("{:.0f} nm\u00b2", m2 / kSquareNm)
                                                           : fmt::format("{:.2f} \u00b5m\u00b2", m2 / kSquareUm));
  }

  bool writes() const { return now_.push.state != physics::PushState::Free; }

  void add_contact() {
    add(Phrase::PushStateName, phrases_[writes() ? Phrase::InkWrites : Phrase::InkFree], "");
    const double pull_n = scene::meniscus_pull_n(now_.set->setup.tip.radius.si, ink().surface_tension.si);
    add(Phrase::InkForce, text(physics::Force(now_.push.lift_n), physics::kForceUnits),
        phrases_.text<Phrase::InkTears>(text(physics::Force(pull_n), physics::kForceUnits)));
  }

  void add_writing() {
    if (writes()) {
      const Velocity speed(now_.push.ink.speed_m_per_s);
      const bool moves = speed.si > kRestsMPerS;
      add(Phrase::InkLine, moves ? text(physics::ink_line_width(ink().ink, speed), physics::kLengthUnits) : "-",
          moves ? phrases_.text<Phrase::InkLineOf>(text(speed, physics::kVelocityUnits)) : phrases_[Phrase::InkRests]);
      const physics::Time time(now_.push.ink.flowed_s);
      add(Phrase::InkDot, text(2.0 * physics::ink_dot_radius(ink().ink, time), physics::kLengthUnits),
          phrases_.text<Phrase::InkDotOf>(text(time, physics::kTimeUnits)));
    }
    add(Phrase::InkCovered, area(now_.push.ink.covered_m2), phrases_[Phrase::InkCoveredOf]);
  }

  void add_numbers() {
    add_sourced(Phrase::InkFlow,
                phrases_.text<Phrase::InkMolecules>(phrases_.number(fmt::format("{:.3g}", ink().ink.molecules_per_s))),
                "molecules_per_s");
    add_sourced(Phrase::InkTension, text(physics::Stiffness(ink().surface_tension.si), physics::kStiffnessUnits),
                "surface_tension");
    add_sourced(Phrase::InkLever, text(now_.set->setup.springs.normal, physics::kStiffnessUnits), "normal_spring");
    add_softened(now_.push.softened_upwards);
  }
};

}  // namespace

render::DataPanel ink_panel(const ParticlesNow& now, const Phrases& phrases) {
  return {.title = phrases.word(now.set->title),
          .subtitle = phrases.text<Phrase::InkTakeBack>(fmt::format("{}", now.push.strokes)),
          .rows = InkRows(now, phrases).take(),
          .details = false};
}

}  // namespace afm::exhibit
