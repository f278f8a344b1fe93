// SPDX-License-Identifier: Apache-2.0
#include "exhibit/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/percentiles.h"
#include "core/version.h"
#include "core/written_by.h"
#include "curves/felt_sources.h"
#include "curves/html_page.h"
#include "curves/tapping/tapping_output.h"

namespace afm::exhibit {

namespace {

using curves::html_figure;
using curves::html_fitting;
using curves::html_head;
using curves::html_heading;
using curves::html_note;
using curves::html_one_eye;
using curves::html_picture;
using curves::html_scrolled;
using curves::html_table_head;
using curves::html_text;

nlohmann::json json_of(const core::Percentiles& p) {
  return {{"p50", p.p50}, {"p99", p.p99}, {"p99.9", p.p999}, {"max", p.max}};
}

// Measurement in tapping mode: heights and swings instead of forces.
nlohmann::json json_of(const Measurement& m, const TappedCycle& tapped) {
  nlohmann::json json = tapped_json(tapped);
  const CycleEvents error = m.error_vs_calculation();
  json.update({{"law", m.law}, {"hysteretic", m.hysteretic}, {"loop_energy_J", m.loop_energy_j}});
  json["error_vs_calculation"] = nlohmann::json::object();
  if (m.hysteretic)
    json["error_vs_calculation"] = {{"z_to_repulsion", error.z_jtc_m}, {"z_to_attraction", error.z_joc_m}};
  return json;
}

nlohmann::json json_of(const Measurement& m) {
  if (m.tapped) return json_of(m, *m.tapped);
  const auto or_null = [](bool there, double value) { return there ? nlohmann::json(value) : nlohmann::json(); };
  const CycleEvents error = m.error_vs_calculation();
  nlohmann::json json{{"law", m.law},
                      {"hysteretic", m.hysteretic},
                      {"fold_N", m.fold_n},
                      {"loop_energy_J", m.loop_energy_j},
                      {"f_attr_N", or_null(m.snaps_in, m.measured.f_attr_n)},
                      {"f_ad_N", or_null(m.pulls_off, m.measured.f_ad_n)},
                      {"z_jtc_m", or_null(m.snaps_in, m.measured.z_jtc_m)},
                      {"z_joc_m", m.measured.z_joc_m},
                      {"sampled_f_attr_N", m.sampled_f_attr_n},
                      {"sampled_f_ad_N", m.sampled_f_ad_n},
                      {"error_vs_calculation",
                       {{"f_attr", or_null(m.snaps_in, error.f_attr_n)},
                        {"f_ad", or_null(m.pulls_off, error.f_ad_n)},
                        {"z_jtc", or_null(m.snaps_in, error.z_jtc_m)},
                        {"z_joc", error.z_joc_m}}},
                      {"error_vs_experiment", nlohmann::json::object()}};
  if (const auto f_attr = m.experiment_error_f_attr()) json["error_vs_experiment"]["f_attr"] = *f_attr;
  if (const auto f_ad = m.experiment_error_f_ad()) json["error_vs_experiment"]["f_ad"] = *f_ad;
  if (m.recorded) {
    json["recorded"] = {{"f_attr_N", or_null(m.snaps_in, m.calculation.f_attr_n)},
                        {"f_ad_N", or_null(m.pulls_off, m.calculation.f_ad_n)},
                        {"z_jtc_m", or_null(m.snaps_in, m.calculation.z_jtc_m)},
                        {"z_joc_m", m.calculation.z_joc_m},
                        {"loop_energy_J", m.recorded_loop_energy_j}};
    json["error_vs_calculation"]["loop_energy"] = m.error_of_loop_energy();
  }
  return json;
}

constexpr const char* kNone = "\u2013";

// Writes the rows of the table of events.
class EventRows {
 public:
  explicit EventRows(const Phrases& phrases) : phrases_(phrases) {}

  void add(const Measurement& m) {
    const std::string title = phrases_.word(m.title);
    if (m.tapped && m.hysteretic) return add_jumps(m, title);
    if (!m.hysteretic) {
      return note(fmt::format("{} ({})", title, m.law), phrases_[m.tapped ? Phrase::NoJumps : Phrase::ReportNoJumps]);
    }
    if (m.recorded) {
      note(title, phrases_.text<Phrase::ReportRecording>(
                      phrases_[m.snaps_in ? Phrase::ReportSnapsIn : Phrase::ReportNoSnapIn],
                      phrases_[m.pulls_off ? Phrase::ReportPullsOff : Phrase::ReportNoPullOff],
                      fmt::format("{:.4g} aJ", m.loop_energy_j * 1e18),
                      fmt::format("{:.4g} aJ", m.recorded_loop_energy_j * 1e18)));
    }
    const CycleEvents &simulated = m.measured, &calculated = m.calculation;
    if (m.snaps_in) {
      row({fmt::format("{} ({})", title, m.law), "F_attr", "nN"}, calculated.f_attr_n, simulated.f_attr_n,
          m.sampled_f_attr_n, m.experiment_f_attr_n, m.experiment_error_f_attr());
      row({title, "Z_jtc", "nm"}, calculated.z_jtc_m, simulated.z_jtc_m);
    }
    if (!m.pulls_off) return;
    row({title, "F_ad", "nN"}, calculated.f_ad_n, simulated.f_ad_n, m.sampled_f_ad_n, m.experiment_f_ad_n,
        m.experiment_error_f_ad());
    row({title, "Z_joc", "nm"}, calculated.z_joc_m, simulated.z_joc_m);
  }

  const std::string& html() const { return html_; }

 private:
  struct Name {
    std::string sample;
    const char* quantity;
    const char* unit;  // unit of the values, which are SI times 1e9
  };

  void add_jumps(const Measurement& m, const std::string& title) {
    row({fmt::format("{} ({})", title, m.law), "Z \u2193", "nm"}, m.calculation.z_jtc_m, m.measured.z_jtc_m);
    row({title, "Z \u2191", "nm"}, m.calculation.z_joc_m, m.measured.z_joc_m);
    note(title, phrases_.number(fmt::format("\u2193 {}; \u2191 {}", jump_text(*m.tapped->to_repulsion),
                                            jump_text(*m.tapped->to_attraction))));
  }

  void note(const std::string& sample, const std::string& text) {
    html_ += fmt::format("<tr><td>{}</td><td colspan=\"7\">{}</td></tr>\n", html_text(sample), html_text(text));
  }

  void row(const Name& name, double calculated, double simulated, std::optional<double> sampled = {},
           std::optional<double> experiment = {}, std::optional<double> experiment_error = {}) {
    const auto quantity = [&](std::optional<double> si) {
      return si ? phrases_.number(fmt::format("{:.5g} {}", *si * 1e9, name.unit)) : kNone;
    };
    const auto percent = [&](std::optional<double> relative) {
      return relative ? phrases_.number(fmt::format("{:+.3f} %", 100.0 * *relative)) : kNone;
    };
    html_ += fmt::format("<tr><td>{}</td><td>{}</td>", html_text(name.sample), html_text(name.quantity));
    for (const std::string& cell : {quantity(calculated), quantity(simulated), percent(simulated / calculated - 1.0),
                                    quantity(sampled), quantity(experiment), percent(experiment_error)}) {
      html_ += "<td>" + cell + "</td>";
    }
    html_ += "</tr>\n";
  }

  const Phrases& phrases_;
  std::string html_;
};

std::string events_table(const DemoResult& result, const Phrases& phrases) {
  using enum Phrase;
  EventRows rows(phrases);
  for (const Measurement& m : result.measurements) rows.add(m);
  for (const Variation& variation : result.variations) rows.add(variation.measurement);
  const std::string head =
      html_table_head({phrases[ReportSample], phrases[ReportQuantity], phrases[ReportCalculation],
                       phrases[ReportSimulation], phrases[ReportVersusCalculation], phrases[ReportSampled],
                       phrases[ReportExperiment], phrases[ReportVersusExperiment]});
  return html_scrolled(head + rows.html() + "</table>") + "\n";
}

bool is_tapped(const DemoResult& result) { return !result.measurements.empty() && result.measurements.front().tapped; }

// Time in the unit that leaves 1 to 1000 before the point: "11.49 ms".
std::string time_text(double seconds) {
  static constexpr std::array<std::pair<double, const char*>, 3> kTimeUnits{
      {{1.0, "s"}, {1e-3, "ms"}, {1e-6, "\u00b5s"}}};
  const auto* unit = kTimeUnits.begin();
  while (unit + 1 != kTimeUnits.end() && std::abs(seconds) < unit->first) ++unit;
  return fmt::format("{:.4g} {}", seconds / unit->first, unit->second);
}

std::string timing_table(const DemoResult& result, const Phrases& phrases) {
  using enum Phrase;
  const auto row = [&](Phrase name, double unit_s, const core::Percentiles& p) {
    std::string html = "<tr><td>" + html_text(phrases[name]) + "</td>";
    for (const double value : {p.p50, p.p99, p.p999, p.max}) {
      html += "<td>" + phrases.number(time_text(value * unit_s)) + "</td>";
    }
    return html + "</tr>\n";
  };
  const scene::ServoTiming& servo = result.servo;
  return html_scrolled(
             html_table_head({phrases[ReportWhat], "p50", "p99", phrases.number("p99.9"), phrases[ReportMaximum]}) +
             row(ReportWakeUp, 1e-6, core::percentiles(servo.wake_us, servo.wake_max_us)) +
             row(ReportWork, 1e-6, core::percentiles(servo.work_us, servo.work_max_us)) +
             row(ReportFrame, 1e-3, core::percentiles(result.frame_ms)) + "</table>") +
         "\n";
}

std::string run_html(const DemoResult& result, const Phrases& phrases) {
  using enum Phrase;
  const std::size_t samples = result.measurements.size();
  const std::string title =
      samples == 1 ? phrases[ReportHeadingOne] : phrases.text<ReportHeading>(std::to_string(samples));
  const std::string run = phrases.text<ReportRun>(
      core::kVersion, fmt::format("{:.0f} s", result.seconds), phrases.word(result.haptic_device),
      fmt::format("{:.0f} mm/s", result.hand_speed_m_per_s * 1e3), std::to_string(result.frame_ms.size()),
      fmt::format("2 \u00d7 {} \u00d7 {}", result.eye_width, result.eye_height), result.vulkan_device);
  return "<h1>" + html_text(title) + "</h1>\n" + html_note(html_text(run));
}

// Head of the page: one picture for everybody who cannot merge a pair, and the forces of each sample.
std::string results_html(const DemoResult& result, const std::vector<ReportPicture>& pictures, const Phrases& phrases) {
  using enum Phrase;
  std::string html;
  const auto shown = std::find_if(pictures.begin(), pictures.end(), [&](const ReportPicture& picture) {
    return picture.caption == phrases[is_tapped(result) ? CaptionRepelled : CaptionAdhesion];
  });
  if (shown != pictures.end() && result.eye_width > 0) {
    html += html_figure(html_one_eye(shown->png, shown->caption, result.eye_width, result.eye_height), shown->caption);
  }
  std::string rows;
  for (const Measurement& m : result.measurements) {
    const auto force = [](bool there, double force_n) {
      return there ? fmt::format("{:.3f}", force_n * 1e9) : std::string(kNone);
    };
    std::string figures =
        fmt::format("{} / {} nN", force(m.snaps_in, m.measured.f_attr_n), force(m.pulls_off, m.measured.f_ad_n));
    if (m.tapped) figures = fmt::format("{:.2f} / {:.2f} nm", m.measured.z_jtc_m * 1e9, m.measured.z_joc_m * 1e9);
    figures = m.hysteretic ? phrases.number(figures) : phrases[NoJumps];
    rows += fmt::format("<li><b>{}</b>: {}</li>\n", html_text(phrases.word(m.title)), html_text(figures));
  }
  if (rows.empty()) return html;
  return html + html_note(html_text(phrases[is_tapped(result) ? JumpsOfSwing : SnapInAndPullOff])) +
         "<ul class=\"results\">\n" + rows + "</ul>\n";
}

std::string servo_html(const scene::ServoTiming& servo, std::uint64_t lost_samples, const Phrases& phrases) {
  using enum Phrase;
  const std::string policy =
      servo.policy_fifo != 0 ? "SCHED_FIFO" : phrases.text<ReportNotRealTime>(std::string("SCHED_OTHER"));
  return html_note(html_text(phrases.text<ReportServo>(
      fmt::format("{:.0f}", servo.rate_hz), policy,
      phrases[servo.pages_locked != 0 ? ReportPagesLocked : ReportPagesNotLocked], std::to_string(servo.ticks),
      std::to_string(servo.missed), std::to_string(lost_samples))));
}

// Cycle of a session, from the highest base before the lowest one to the highest after it; everything before and
// after is the hand's path there and back.
struct RecordedCycle {
  std::size_t begin = 0, lowest = 0, end = 0;

  std::string_view branch_of(std::size_t sample) const {
    if (sample < begin || sample > end) return "";
    return sample <= lowest ? "approach" : "retract";
  }
};

RecordedCycle cycle_of(const std::vector<scene::TipSample>& samples) {
  const auto lower = [](const scene::TipSample& a, const scene::TipSample& b) { return a.tip.z_m < b.tip.z_m; };
  const auto lowest = std::min_element(samples.begin(), samples.end(), lower);
  const auto place = [&](auto found) { return static_cast<std::size_t>(found - samples.begin()); };
  return {place(std::max_element(samples.begin(), lowest, lower)), place(lowest),
          lowest == samples.end() ? 0 : place(std::max_element(lowest, samples.end(), lower))};
}

// Parameters of the felt contact with their sources, which every session of a demo has.
nlohmann::json numbers_of(const servo::RecordedSession& session) {
  return nlohmann::json(curves::session_numbers(session.material, session.parameters, session.sources, {}));
}

}  // namespace

nlohmann::json summary_json(const DemoResult& result) {
  nlohmann::json materials = nlohmann::json::object();
  for (std::size_t i = 0; i < result.measurements.size(); ++i) {
    nlohmann::json& measured = materials[result.measurements[i].material] = json_of(result.measurements[i]);
    if (i < result.sessions.size()) measured.update(numbers_of(result.sessions[i]));
  }
  nlohmann::json variations = nlohmann::json::array();
  for (const Variation& variation : result.variations) {
    variations.push_back(json_of(variation.measurement));
    variations.back().update(numbers_of(variation.session));
    variations.back()["material"] = variation.measurement.material;
    variations.back()["title"] = variation.measurement.title;
  }
  nlohmann::json summary{{"materials", materials},
                         {"variations", variations},
                         {"servo",
                          {{"rate_hz", result.servo.rate_hz},
                           {"policy", result.servo.policy_fifo != 0 ? "SCHED_FIFO" : "SCHED_OTHER"},
                           {"priority", result.servo.priority},
                           {"pages_locked", result.servo.pages_locked != 0},
                           {"ticks", result.servo.ticks},
                           {"missed", result.servo.missed},
                           {"lost_samples", result.lost_samples},
                           {"wake_us", json_of(core::percentiles(result.servo.wake_us, result.servo.wake_max_us))},
                           {"work_us", json_of(core::percentiles(result.servo.work_us, result.servo.work_max_us))}}},
                         {"frames",
                          {{"count", result.frame_ms.size()},
                           {"eye_width", result.eye_width},
                           {"eye_height", result.eye_height},
                           {"ms", json_of(core::percentiles(result.frame_ms))}}},
                         {"device", {{"vulkan", result.vulkan_device}, {"haptic", result.haptic_device}}},
                         {"hand_speed_m_per_s", result.hand_speed_m_per_s},
                         {"seconds", result.seconds},
                         {"versions", {{"touchafm", core::kVersion}}}};
  core::name_software(summary);
  return summary;
}

std::string report_html(const DemoResult& result, const std::vector<ReportPicture>& pictures,
                        const std::string& curves_svg, const Phrases& phrases) {
  using enum Phrase;
  std::string html = html_head(phrases[Language], phrases[ReportTitle]) + run_html(result, phrases);
  html += results_html(result, pictures, phrases);
  const bool tapped = is_tapped(result);
  html += html_heading(phrases[tapped ? PlotTitleTapping : ReportCurves]) +
          html_fitting(html_figure(curves_svg, phrases[tapped ? ReportTappedCurvesNote : ReportCurvesNote]));
  html += html_heading(phrases[tapped ? JumpsOfSwing : ReportTable]) + events_table(result, phrases);
  html += html_note(html_text(phrases[tapped ? ReportTappedTableNote : ReportTableNote]));
  html += html_heading(phrases[ReportWall]) + html_note(html_text(phrases[ReportWallNote]));
  for (const ReportPicture& picture : pictures) {
    html += html_figure(html_picture(picture.png, picture.caption), picture.caption);
  }
  html += html_heading(phrases[ReportTiming]) + timing_table(result, phrases);
  return html + servo_html(result.servo, result.lost_samples, phrases) + "</body></html>\n";
}

std::string session_csv(const servo::RecordedSession& session) {
  const scene::SharedContact& m = session.parameters;
  const RecordedCycle cycle = cycle_of(session.samples);
  fmt::memory_buffer csv;
  const auto out = std::back_inserter(csv);
  fmt::format_to(out, "# TouchAFM force-displacement curve, as the servo recorded it\n# software: {}\n",
                 core::written_by());
  fmt::format_to(out, "# material: {}\n# model: {}\n# samples: {}\n", session.material, curves::law_name(m),
                 session.samples.empty() ? 0 : cycle.end - cycle.begin + 1);
  for (const physics::ContactField& field : physics::kContactFields) {
    fmt::format_to(out, "# {}: {}\n", field.json_key, field.get(m.contact));
  }
  if (m.dynamic != 0) {
    fmt::format_to(out, "# resonance_Hz: {}\n# quality_factor: {}\n# temperature_K: {}\n# slow_motion: {}\n",
                   m.lever.resonance.si, m.lever.quality_factor, m.lever.temperature.si, session.slow_motion);
  }
  const bool tapped = scene::taps(m);
  if (tapped) {
    fmt::format_to(out, "# resonance_Hz: {}\n# quality_factor: {}\n# free_amplitude_m: {}\n# drive_Hz: {}\n",
                   m.lever.resonance.si, m.lever.quality_factor, m.free_amplitude_m, m.drive_hz);
    fmt::format_to(out, "# viscosity_Pa_s: {}\n# slow_motion: {}\n", m.viscosity_pa_s, session.slow_motion);
    const nlohmann::ordered_json conventions = curves::tapping_conventions();
    for (const auto& [name, meaning] : conventions.items()) {
      fmt::format_to(out, "# convention of the {}: {}\n", name, meaning.get<std::string>());
    }
  }
  csv.append(curves::source_lines(session.sources));
  fmt::format_to(out, "# servo_rate_Hz: {}\n# hand_m_per_m: {}\n# hand_N_per_N: {}\n", session.rate_hz,
                 session.hand_m_per_m, session.hand_n_per_n);
  fmt::format_to(
      out,
      "# signs: force on the tip, positive away from the sample; Z is the piezo displacement; rows without a "
      "branch are no part of the cycle\n");
  for (const scene::TipEvent& e : session.events) {
    fmt::format_to(out, "# event: {} at t_s={:.9f} z_m={:.12e} force_before_N={:.12e} force_after_N={:.12e}\n",
                   physics::name_of(e.kind), session.seconds_since_start(e.time_ns), e.z_m, e.force_before_n,
                   e.force_after_n);
  }
  fmt::format_to(out,
                 "time_s,z_m,force_N,tip_height_m,deflection_m,sample_deformation_m,hand_height_m,hand_force_N,{}servo_"
                 "state,phase,branch\n",
                 tapped ? "amplitude_m,phase_deg," : "");
  for (std::size_t i = 0; i < session.samples.size(); ++i) {
    const scene::TipSample& s = session.samples[i];
    const std::string swing =
        tapped ? fmt::format("{:.9e},{:.4f},", s.swing.amplitude_m, s.swing.phase_rad * 180.0 / std::numbers::pi) : "";
    fmt::format_to(out, "{:.6f},{:.9e},{:.9e},{:.9e},{:.9e},{:.9e},{:.9e},{:.9e},{}{},{},{}\n",
                   session.seconds_since_start(s.time_ns), s.tip.z_m, s.tip.force_n, s.tip.height_m, s.tip.deflection_m,
                   s.tip.sample_deformation_m, s.hand_height_m, s.hand_force_n, swing,
                   static_cast<std::uint32_t>(s.servo_state), static_cast<std::uint32_t>(s.phase), cycle.branch_of(i));
  }
  return fmt::to_string(csv);
}

}  // namespace afm::exhibit
