// SPDX-License-Identifier: Apache-2.0
#include "app/demo/measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace afm::app {

namespace {

double relative(double value, double reference) { return value / reference - 1.0; }

}  // namespace

CycleEvents Measurement::error_vs_calculation() const {
  if (!hysteretic) return {};
  const double z_scale_m = calculation.z_jtc_m != 0.0 ? std::abs(calculation.z_jtc_m) : std::abs(calculation.z_joc_m);
  return {.f_attr_n = relative(measured.f_attr_n, calculation.f_attr_n),
          .f_ad_n = relative(measured.f_ad_n, calculation.f_ad_n),
          .z_jtc_m = (measured.z_jtc_m - calculation.z_jtc_m) / z_scale_m,
          .z_joc_m = relative(measured.z_joc_m, calculation.z_joc_m)};
}

std::optional<double> Measurement::experiment_error_f_attr() const {
  if (!hysteretic || !experiment_f_attr_n) return std::nullopt;
  return relative(measured.f_attr_n, *experiment_f_attr_n);
}

std::optional<double> Measurement::experiment_error_f_ad() const {
  if (!hysteretic || !experiment_f_ad_n) return std::nullopt;
  return relative(measured.f_ad_n, *experiment_f_ad_n);
}

double Measurement::worst_error() const {
  if (!judged) return 0.0;
  const CycleEvents e = error_vs_calculation();
  return std::max({std::abs(e.f_attr_n), std::abs(e.f_ad_n), std::abs(e.z_jtc_m), std::abs(e.z_joc_m)});
}

core::Result<Measurement> measure(const servo::RecordedSession& session, const curves::SampleModel& material) {
  const physics::CycleFigures& figures = material.figures();
  const scene::TipEvent* in = session.find(physics::EventKind::JumpToContact);
  const scene::TipEvent* out = session.find(physics::EventKind::JumpOffContact);
  if (figures.hysteretic && (in == nullptr || out == nullptr)) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("{}: the recorded cycle has no {}; run the demo again", session.material,
                                     in == nullptr ? "jump to contact" : "jump off contact"));
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
  m.fold_n = std::abs(figures.force_before_jtc.si);
  m.loop_energy_j = figures.loop_energy.si;
  if (const auto& f = material.setup.material.experiment_f_attr) m.experiment_f_attr_n = f->si;
  if (const auto& f = material.setup.material.experiment_f_ad) m.experiment_f_ad_n = f->si;

  const auto first_attached =
      std::find_if(session.samples.begin(), session.samples.end(),
                   [&](const scene::TipSample& s) { return s.phase == physics::Phase::Attached; });
  if (first_attached != session.samples.end()) m.sampled_f_attr_n = std::abs(first_attached->tip.force_n);
  for (const scene::TipSample& s : session.samples) m.sampled_f_ad_n = std::max(m.sampled_f_ad_n, -s.tip.force_n);
  return m;
}

}  // namespace afm::app
