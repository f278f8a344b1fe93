// SPDX-License-Identifier: Apache-2.0
#include "app/measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace afm::app {

namespace {

double relative(double value, double reference) { return value / reference - 1.0; }

std::size_t rank(double fraction, std::size_t count) {
  return std::min(count - 1, static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(count))) - 1);
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

core::Result<Measurement> measure(const RecordedSession& session, const FeltMaterial& material) {
  const physics::CycleFigures& figures = material.figures();
  const scene::TipEvent* in = session.find(scene::TipEventKind::JumpToContact);
  const scene::TipEvent* out = session.find(scene::TipEventKind::JumpOffContact);
  if (figures.hysteretic && (in == nullptr || out == nullptr)) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("{}: the recorded cycle has no {}; run the demo again", session.material,
                                     in == nullptr ? "jump to contact" : "jump off contact"));
  }
  Measurement m;
  m.material = session.material;
  m.title = material.setup.material.title;
  m.law = law_name(material.parameters);
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
                   [&](const scene::TipSample& s) { return s.phase == scene::ContactPhase::Attached; });
  if (first_attached != session.samples.end()) m.sampled_f_attr_n = std::abs(first_attached->force_n);
  for (const scene::TipSample& s : session.samples) m.sampled_f_ad_n = std::max(m.sampled_f_ad_n, -s.force_n);
  return m;
}

Percentiles percentiles(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double fraction) { return values[rank(fraction, values.size())]; };
  return {.p50 = at(0.5), .p99 = at(0.99), .p999 = at(0.999), .max = values.back()};
}

Percentiles percentiles(std::span<const std::uint32_t> bins, std::uint32_t max_us) {
  const std::uint64_t total = std::accumulate(bins.begin(), bins.end(), std::uint64_t{0});
  if (total == 0) return {};
  const auto at = [&](double fraction) {
    std::uint64_t seen = 0;
    const std::uint64_t wanted = rank(fraction, total) + 1;
    for (std::size_t i = 0; i < bins.size(); ++i) {
      seen += bins[i];
      // the last bin holds all that is longer, and says nothing but the maximum
      if (seen >= wanted) return i + 1 == bins.size() ? double(max_us) : static_cast<double>(i + 1);
    }
    return double(max_us);
  };
  return {.p50 = at(0.5), .p99 = at(0.99), .p999 = at(0.999), .max = double(max_us)};
}

}  // namespace afm::app
