// SPDX-License-Identifier: Apache-2.0
#include "app/demo/report.h"
#include "core/percentiles.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/version.h"

namespace afm::app {

namespace {

nlohmann::json json_of(const CycleEvents& e) {
  return {{"f_attr", e.f_attr_n}, {"f_ad", e.f_ad_n}, {"z_jtc", e.z_jtc_m}, {"z_joc", e.z_joc_m}};
}

nlohmann::json json_of(const core::Percentiles& p) {
  return {{"p50", p.p50}, {"p99", p.p99}, {"p99.9", p.p999}, {"max", p.max}};
}

nlohmann::json json_of(const Measurement& m) {
  const auto or_null = [](bool there, double value) { return there ? nlohmann::json(value) : nlohmann::json(); };
  nlohmann::json json{{"law", m.law},
                      {"hysteretic", m.hysteretic},
                      {"fold_N", m.fold_n},
                      {"loop_energy_J", m.loop_energy_j},
                      {"f_attr_N", or_null(m.snaps_in, m.measured.f_attr_n)},
                      {"f_ad_N", or_null(m.pulls_off, m.measured.f_ad_n)},
                      {"z_jtc_m", m.measured.z_jtc_m},
                      {"z_joc_m", m.measured.z_joc_m},
                      {"sampled_f_attr_N", m.sampled_f_attr_n},
                      {"sampled_f_ad_N", m.sampled_f_ad_n},
                      {"error_vs_calculation", json_of(m.error_vs_calculation())},
                      {"error_vs_experiment", nlohmann::json::object()}};
  if (const auto error = m.experiment_error_f_attr()) json["error_vs_experiment"]["f_attr"] = *error;
  if (const auto error = m.experiment_error_f_ad()) json["error_vs_experiment"]["f_ad"] = *error;
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

std::string base64(const std::string& bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      word = word << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? kDigits[word >> (18U - 6U * k) & 63U] : '=';
    }
  }
  return text;
}

std::string signed_percent(double relative) { return fmt::format("{:+.3f} %", 100.0 * relative); }

constexpr const char* kStyle = R"(
body { font: 16px/1.5 Inter, "DejaVu Sans", sans-serif; color: #1c2430; background: #f4f5f7; margin: 0 auto; max-width: 1100px; padding: 1.5em; }
h1 { font-size: 1.7em; margin-bottom: 0.2em; } h2 { margin-top: 1.8em; font-size: 1.25em; }
figure { margin: 1em 0; } figure img, figure svg { width: 100%; height: auto; border-radius: 6px; background: #fff; }
figcaption { color: #4a5568; font-size: 0.93em; margin-top: 0.3em; }
table { border-collapse: collapse; width: 100%; font-size: 0.93em; background: #fff; }
th, td { border: 1px solid #d5dae1; padding: 0.35em 0.6em; text-align: right; } th { background: #e8ebf0; }
td:first-child, th:first-child { text-align: left; }
.note { color: #4a5568; font-size: 0.93em; }
.wide { overflow-x: auto; } .wide:focus { outline: 2px solid #3b82c4; }
@media (max-width: 760px) {
  body { padding: 0.8em; } td, th { white-space: nowrap; }
  .wide img, .wide svg { width: auto; min-width: 900px; } .wide img.pair { min-width: 1400px; }
}
)";

// What is wider than a narrow browser is moved inside its own box; the keyboard reaches that too.
std::string scrolled(const std::string& html) { return "<div class=\"wide\" tabindex=\"0\">" + html + "</div>"; }

std::string events_table(const DemoResult& result) {
  std::string html =
      "<table><tr><th>sample</th><th>quantity</th><th>calculation</th><th>simulation (this run)</th><th>against "
      "calculation</th><th>sampled at the ticks</th><th>experiment</th><th>against experiment</th></tr>\n";
  const auto row = [&](const std::string& sample, const char* name, const char* unit, double calculation,
                       double measured, const std::string& sampled, const std::string& experiment,
                       const std::string& error) {
    html += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{:.5g} {}</td><td>{:.5g} "
        "{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
        sample, name, calculation, unit, measured, unit, signed_percent(measured / calculation - 1.0), sampled,
        experiment, error);
  };
  const auto nn = [](std::optional<double> n) { return n ? fmt::format("{:.5g} nN", *n * 1e9) : "\u2013"; };
  const auto percent = [](std::optional<double> error) { return error ? signed_percent(*error) : "\u2013"; };
  std::vector<Measurement> measurements = result.measurements;
  for (const Variation& variation : result.variations) measurements.push_back(variation.measurement);
  for (const Measurement& m : measurements) {
    if (!m.hysteretic) {
      html += fmt::format(
          "<tr><td>{} ({})</td><td colspan=\"7\">no jumps: so stiff a lever follows the force wherever it "
          "goes</td></tr>\n",
          m.title, m.law);
      continue;
    }
    if (m.recorded) {
      html += fmt::format(
          "<tr><td>{}</td><td colspan=\"7\">a recorded curve: {}{}, loop energy felt {:.4g} aJ, recorded {:.4g} "
          "aJ</td></tr>\n",
          m.title, m.snaps_in ? "snaps in" : "no snap-in", m.pulls_off ? ", pulls off" : ", no pull-off",
          m.loop_energy_j * 1e18, m.recorded_loop_energy_j * 1e18);
    }
    if (m.snaps_in) {
      row(m.title + " (" + m.law + ")", "F<sub>attr</sub>", "nN", m.calculation.f_attr_n * 1e9,
          m.measured.f_attr_n * 1e9, nn(m.sampled_f_attr_n), nn(m.experiment_f_attr_n),
          percent(m.experiment_error_f_attr()));
      row(m.title, "Z<sub>jtc</sub>", "nm", m.calculation.z_jtc_m * 1e9, m.measured.z_jtc_m * 1e9, "\u2013", "\u2013",
          "\u2013");
    }
    if (!m.pulls_off) continue;
    row(m.title, "F<sub>ad</sub>", "nN", m.calculation.f_ad_n * 1e9, m.measured.f_ad_n * 1e9, nn(m.sampled_f_ad_n),
        nn(m.experiment_f_ad_n), percent(m.experiment_error_f_ad()));
    row(m.title, "Z<sub>joc</sub>", "nm", m.calculation.z_joc_m * 1e9, m.measured.z_joc_m * 1e9, "\u2013", "\u2013",
        "\u2013");
  }
  return scrolled(html + "</table>") + "\n";
}

// In the unit that leaves 1 to 1000 before the point: "11.49 ms".
std::string time_text(double seconds) {
  static constexpr std::array<std::pair<double, const char*>, 3> kTimeUnits{
      {{1.0, "s"}, {1e-3, "ms"}, {1e-6, "\u00b5s"}}};
  const auto* unit = kTimeUnits.begin();
  while (unit + 1 != kTimeUnits.end() && std::abs(seconds) < unit->first) ++unit;
  return fmt::format("{:.4g} {}", seconds / unit->first, unit->second);
}

std::string timing_table(const DemoResult& result) {
  const auto row = [](const char* name, double unit_s, const core::Percentiles& p) {
    return fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", name,
                       time_text(p.p50 * unit_s), time_text(p.p99 * unit_s), time_text(p.p999 * unit_s),
                       time_text(p.max * unit_s));
  };
  return scrolled(
             "<table><tr><th>what</th><th>p50</th><th>p99</th><th>p99.9</th><th>max</th></tr>\n" +
             row("servo: late at wake-up", 1e-6, core::percentiles(result.servo.wake_us, result.servo.wake_max_us)) +
             row("servo: work in a tick", 1e-6, core::percentiles(result.servo.work_us, result.servo.work_max_us)) +
             row("renderer: a stereo frame", 1e-3, core::percentiles(result.frame_ms)) + "</table>") +
         "\n";
}

}  // namespace

nlohmann::json summary_json(const DemoResult& result) {
  nlohmann::json materials = nlohmann::json::object();
  for (const Measurement& m : result.measurements) materials[m.material] = json_of(m);
  nlohmann::json variations = nlohmann::json::array();
  for (const Variation& variation : result.variations) {
    variations.push_back(json_of(variation.measurement));
    variations.back()["material"] = variation.measurement.material;
    variations.back()["title"] = variation.measurement.title;
  }
  return {{"materials", materials},
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
}

std::string report_html(const DemoResult& result, const std::vector<ReportPicture>& pictures,
                        const std::string& curves_svg) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><title>TouchAFM: approach and "
      "retract</title>"
      "<style>{}</style></head><body>\n<h1>Approach and retract on {} samples</h1>\n"
      "<p class=\"note\">TouchAFM {} felt one full cycle on each sample in {:.0f} s, with a {} moving at {:.0f} mm/s "
      "on average, "
      "and drew {} stereo frames of 2 \u00d7 {} \u00d7 {} pixels on {}.</p>\n",
      kStyle, result.measurements.size(), core::kVersion, result.seconds, result.haptic_device,
      result.hand_speed_m_per_s * 1e3, result.frame_ms.size(), result.eye_width, result.eye_height,
      result.vulkan_device);
  html += "<h2>Force-displacement curves</h2>\n<figure>" + scrolled(curves_svg) +
          "<figcaption>Every servo sample. Approach dashed, retract solid; force on the tip is positive away from the "
          "sample.</figcaption></figure>\n";
  html += "<h2>Table 2 of the paper, with our columns</h2>\n" + events_table(result);
  html +=
      "<p class=\"note\">Simulation: the force at the place where the hand's path crossed the fold inside a servo "
      "tick; beside it, "
      "what the ticks alone have seen. The agreement of F<sub>ad</sub> with the experiment is circular: the surface "
      "energies were "
      "computed from the measured pull-off forces. Only F<sub>attr</sub> is a prediction. The inertia and the noise of "
      "a "
      "dynamic lever move its jumps, which no calculation at rest can judge.</p>\n";
  html +=
      "<h2>The wall</h2>\n<p class=\"note\">Side by side, left eye left: look at them with parallel eyes, or on a "
      "stereo wall.</p>\n";
  for (const ReportPicture& picture : pictures) {
    html += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n",
                        scrolled(fmt::format("<img class=\"pair\" alt=\"{}\" src=\"data:image/png;base64,{}\">",
                                             picture.caption, base64(picture.png))),
                        picture.caption);
  }
  html += "<h2>Timing</h2>\n" + timing_table(result);
  html += fmt::format(
      "<p class=\"note\">Servo: {:.0f} Hz, {}{}, {} ticks, {} deadlines missed, {} samples lost.</p>\n</body></html>\n",
      result.servo.rate_hz, result.servo.policy_fifo != 0 ? "SCHED_FIFO" : "SCHED_OTHER (not real-time)",
      result.servo.pages_locked != 0 ? ", pages locked" : ", pages not locked", result.servo.ticks, result.servo.missed,
      result.lost_samples);
  return html;
}

std::string session_csv(const servo::RecordedSession& session) {
  const scene::SharedContact& m = session.parameters;
  fmt::memory_buffer csv;
  const auto out = std::back_inserter(csv);
  fmt::format_to(out, "# TouchAFM {}: one approach-retract cycle as the servo recorded it\n", core::kVersion);
  fmt::format_to(out, "# material: {}\n# model: {}\n", session.material, curves::law_name(m));
  for (const physics::ContactField& field : physics::kContactFields) {
    fmt::format_to(out, "# {}: {}\n", field.json_key, field.get(m.contact));
  }
  if (m.dynamic != 0) {
    fmt::format_to(out, "# resonance_Hz: {}\n# quality_factor: {}\n# temperature_K: {}\n# slow_motion: {}\n",
                   m.lever.resonance.si, m.lever.quality_factor, m.lever.temperature.si, session.slow_motion);
  }
  fmt::format_to(out, "# servo_rate_Hz: {}\n# hand_m_per_m: {}\n# hand_N_per_N: {}\n", session.rate_hz,
                 session.hand_m_per_m, session.hand_n_per_n);
  fmt::format_to(out, "# force on the tip, positive away from the sample; Z is the piezo displacement\n");
  for (const scene::TipEvent& e : session.events) {
    fmt::format_to(out, "# event: {} at t_s={:.9f} z_m={:.12e} force_before_N={:.12e} force_after_N={:.12e}\n",
                   e.kind == physics::EventKind::JumpToContact ? "jump-to-contact" : "jump-off-contact",
                   session.seconds_since_start(e.time_ns), e.z_m, e.force_before_n, e.force_after_n);
  }
  fmt::format_to(out,
                 "time_s,z_m,force_N,tip_height_m,deflection_m,sample_deformation_m,hand_height_m,hand_force_N,servo_"
                 "state,phase\n");
  for (const scene::TipSample& s : session.samples) {
    fmt::format_to(out, "{:.6f},{:.9e},{:.9e},{:.9e},{:.9e},{:.9e},{:.9e},{:.9e},{},{}\n",
                   session.seconds_since_start(s.time_ns), s.tip.z_m, s.tip.force_n, s.tip.height_m, s.tip.deflection_m,
                   s.tip.sample_deformation_m, s.hand_height_m, s.hand_force_n,
                   static_cast<std::uint32_t>(s.servo_state), static_cast<std::uint32_t>(s.phase));
  }
  return fmt::to_string(csv);
}

}  // namespace afm::app
