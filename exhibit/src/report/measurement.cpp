// SPDX-License-Identifier: Apache-2.0
#include "exhibit/report/measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

namespace afm::exhibit {

namespace {

// Relative difference; 0 if both are equal, as for a feature that a recording lacks, which is 0 in both.
double relative(double value, double reference) { return value == reference ? 0.0 : value / reference - 1.0; }

// Event in words: "jump to contact".
std::string event_words(physics::EventKind kind) {
  std::string words(physics::name_of(kind));
  std::replace(words.begin(), words.end(), '-', ' ');
  return words;
}

// Strongest attraction on the retract branch.
double hardest_pull_n(const physics::LawTables& tables) {
  constexpr int kSteps = 10000;
  const physics::Length way = tables.figures.z_joc - tables.pressed_to;
  double hardest = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const physics::Length z = tables.pressed_to + way * (static_cast<double>(i) / kSteps);
    hardest = std::max(hardest, -tables.attached.force(z).si);
  }
  return hardest;
}

// A curve that releases gradually has its pull-off at the strongest attraction and no jump there.
void compare_with(const physics::CurveFeatures& recorded, const physics::LawTables& tables, Measurement& m) {
  const physics::Length zero = recorded.contact_point.value_or(physics::Length());
  m.recorded = true;
  m.snaps_in = recorded.snap_in.has_value();
  m.pulls_off = recorded.pull_off.has_value();
  m.recorded_loop_energy_j = recorded.loop_energy.si;
  m.calculation = {m.snaps_in ? std::abs(recorded.snap_in->force_after.si) : 0.0,
                   m.pulls_off ? std::abs(recorded.pull_off->force.si) : 0.0,
                   m.snaps_in ? (recorded.snap_in->z - zero).si : 0.0,
                   recorded.let_go ? (*recorded.let_go - zero).si : 0.0};
  if (!m.snaps_in) m.measured.f_attr_n = 0.0;
  if (!m.pulls_off) m.measured.f_ad_n = 0.0;
  const bool lets_go_at_the_jump = recorded.jumps_off && *recorded.let_go == recorded.pull_off->z;
  if (m.pulls_off && !lets_go_at_the_jump) m.measured.f_ad_n = hardest_pull_n(tables);
}

}  // namespace

CycleEvents Measurement::error_vs_calculation() const {
  if (!hysteretic) return {};
  const double z_scale_m = calculation.z_jtc_m != 0.0 ? std::abs(calculation.z_jtc_m) : std::abs(calculation.z_joc_m);
  return {.f_attr_n = relative(measured.f_attr_n, calculation.f_attr_n),
          .f_ad_n = relative(measured.f_ad_n, calculation.f_ad_n),
          .z_jtc_m = (measured.z_jtc_m - calculation.z_jtc_m) / z_scale_m,
          .z_joc_m = relative(measured.z_joc_m, calculation.z_joc_m)};
}

double Measurement::error_of_loop_energy() const {
  return recorded ? relative(loop_energy_j, recorded_loop_energy_j) : 0.0;
}

std::optional<double> Measurement::experiment_error_f_attr() const {
  if (!hysteretic || !experiment_f_attr_n) return std::nullopt;
  return relative(measured.f_attr_n, *experiment_f_attr_n);
}

std::optional<double> Measurement::experiment_error_f_ad() const {
  if (!hysteretic || !experiment_f_ad_n) return std::nullopt;
  return relative(measured.f_ad_n, *experiment_f_ad_n);
}

double Measurement::error_bound() const {
  return recorded ? kRecordingErrorBound : tapped ? kTappingErrorBound : kEventErrorBound;
}

double Measurement::worst_error() const {
  if (!judged) return 0.0;
  const CycleEvents e = error_vs_calculation();
  // heights are not compared, because a recording has them only to the width of its bins
  if (recorded) return std::max({std::abs(e.f_attr_n), std::abs(e.f_ad_n), std::abs(error_of_loop_energy())});
  return std::max({std::abs(e.f_attr_n), std::abs(e.f_ad_n), std::abs(e.z_jtc_m), std::abs(e.z_joc_m)});
}

core::Result<Measurement> measure(const servo::RecordedSession& session, const curves::SampleModel& material,
                                  const physics::CurveFeatures* recorded) {
  const physics::CycleFigures& figures = material.figures();
  const auto [in_kind, out_kind] =
      material.taps() ? std::pair(physics::EventKind::JumpToRepulsion, physics::EventKind::JumpToAttraction)
                      : std::pair(physics::EventKind::JumpToContact, physics::EventKind::JumpOffContact);
  const scene::TipEvent *in = session.find(in_kind), *out = session.find(out_kind);
  if (figures.hysteretic && (in == nullptr || out == nullptr)) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("{}: the recorded cycle has no {}; run the demo again", session.material,
                                     event_words(in == nullptr ? in_kind : out_kind)));
  }
  Measurement m;
  m.material = session.material;
  m.title = material.setup.material.title;
  m.law = curves::law_name(material.parameters);
  m.hysteretic = figures.hysteretic;
  m.judged = !material.dynamic();
  if (m.hysteretic) m.measured = {std::abs(in->force_after_n), std::abs(out->force_before_n), in->z_m, out->z_m};
  m.calculation = {std::abs(figures.force_after_jtc.si), std::abs(figures.force_before_joc.si), figures.z_jtc.si,
                   figures.z_joc.si};
  if (material.taps()) {
    m.tapped = tapped_cycle(session);
    m.measured.f_attr_n = m.measured.f_ad_n = m.calculation.f_attr_n = m.calculation.f_ad_n = 0.0;
  }
  m.fold_n = std::abs(figures.force_before_jtc.si);
  m.loop_energy_j = figures.loop_energy.si;
  if (recorded != nullptr) compare_with(*recorded, *material.tables, m);
  if (const auto& f = material.setup.material.experiment_f_attr; f && !m.tapped) m.experiment_f_attr_n = f->si;
  if (const auto& f = material.setup.material.experiment_f_ad; f && !m.tapped) m.experiment_f_ad_n = f->si;

  const auto first_attached =
      std::find_if(session.samples.begin(), session.samples.end(),
                   [&](const scene::TipSample& s) { return s.phase == physics::Phase::Attached; });
  if (first_attached != session.samples.end()) m.sampled_f_attr_n = std::abs(first_attached->tip.force_n);
  for (const scene::TipSample& s : session.samples) m.sampled_f_ad_n = std::max(m.sampled_f_ad_n, -s.tip.force_n);
  return m;
}

core::Result<void> check_accuracy(const Measurement& m) {
  if (m.worst_error() <= m.error_bound()) return {};
  return core::failure(
      core::ErrorCategory::Failed,
      fmt::format("{}: {} differs by {:.3g} % from the {}; the limit is {} %; see summary.json", m.title,
                  m.recorded ? "an event or the loop energy" : "an event", 100.0 * m.worst_error(),
                  m.recorded ? "recorded curve" : "equations", 100.0 * m.error_bound()));
}

}  // namespace afm::exhibit
