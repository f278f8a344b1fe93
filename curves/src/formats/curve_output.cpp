// SPDX-License-Identifier: Apache-2.0
#include "curves/curve_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <future>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "bytes/text_table.h"
#include "core/written_by.h"
#include "curves/plot_units.h"
#include "physics/force_laws.h"

namespace afm::curves {
namespace {

using json = nlohmann::ordered_json;
using physics::EventKind;

const char* name_of(physics::Phase phase) {
  switch (phase) {
    case physics::Phase::WaitForLift:
      return "wait_for_lift";
    case physics::Phase::Free:
      return "free";
    case physics::Phase::Attached:
      break;
  }
  return "attached";
}

const char* name_of(std::optional<EventKind> event) {
  if (!event) return "";
  return *event == EventKind::JumpToContact ? "jump_to_contact" : "jump_off_contact";
}

// Appends the fewest digits that read back as the same number. Three times as fast as fmt; most of a curve is numbers.
void append_number(std::string& text, double value) {
  std::array<char, 32> digits{};
  // adding zero turns -0 into 0
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value + 0.0);
  text.append(digits.data(), end.ptr);
}

using Samples = std::span<const physics::CurveSample>;

constexpr std::size_t kRowBytes = 136;

void append_rows(std::string& text, Samples samples) {
  text.reserve(text.size() + samples.size() * kRowBytes);
  for (const auto& s : samples) {
    for (const double value :
         {s.z.si, s.force.si, s.tip_height.si, s.cantilever_deflection.si, s.sample_deformation.si}) {
      append_number(text, value);
      text += ',';
    }
    text += s.branch == physics::Branch::Approach ? "approach," : "retract,";
    text += name_of(s.phase);
    text += ',';
    text += name_of(s.event);
    text += '\n';
  }
}

bool is_swept(std::string_view key, std::span<const ContactParameter* const> swept) {
  return std::any_of(swept.begin(), swept.end(), [&](const ContactParameter* parameter) {
    const auto& keys = parameter->source_keys;
    return parameter->json_key == key || std::find(keys.begin(), keys.end(), key) != keys.end();
  });
}

std::vector<scene::SourcedValue> sources_of_numbers(const ContactSetup& setup,
                                                    std::span<const ContactParameter* const> swept) {
  std::vector<scene::SourcedValue> result;
  for (const scene::SourcedValue& source : setup.material.sources) {
    if (is_swept(source.key, swept)) continue;
    for (const ContactParameter& parameter : contact_parameters()) {
      const auto& keys = parameter.source_keys;
      if (std::find(keys.begin(), keys.end(), source.key) == keys.end()) continue;
      if (acts(parameter, setup.model) && parameter.get(setup)) result.push_back(source);
    }
  }
  return result;
}

json finite_or_null(double value) { return std::isfinite(value) ? json(value + 0.0) : json(); }

json snap_in_json(const CurveRun& run) {
  const auto* event = find_event(run.curve, EventKind::JumpToContact);
  if (event == nullptr) return nullptr;
  json result{{"z_m", event->z.si},
              {"force_before_N", event->force_before.si + 0.0},
              {"force_after_N", event->force_after.si + 0.0}};
  if (run.motion || run.setup.model.direction_rule) return result;
  result["tip_height_before_m"] = run.figures.tip_height_before_jtc.si + 0.0;
  result["tip_height_after_m"] = run.figures.tip_height_after_jtc.si + 0.0;
  result["energy_lost_J"] = run.figures.lost_at_jtc.si;
  return result;
}

json pull_off_json(const CurveRun& run) {
  const auto* event = find_event(run.curve, EventKind::JumpOffContact);
  if (event == nullptr) return nullptr;
  json result{{"z_m", event->z.si}, {"force_N", event->force_before.si + 0.0}};
  if (run.motion || run.setup.model.direction_rule) return result;
  result["force_after_N"] = run.figures.force_after_joc.si + 0.0;
  result["tip_height_before_m"] = run.figures.tip_height_before_joc.si + 0.0;
  result["tip_height_after_m"] = run.figures.tip_height_after_joc.si + 0.0;
  result["energy_lost_J"] = run.figures.lost_at_joc.si;
  return result;
}

std::string run_header(const CurveRun& run) {
  std::string text =
      fmt::format("{}# from_m: {}\n# to_m: {}\n# step_m: {}\n", setup_header(run.setup, run.model, run.place),
                  run.plan.from.si, run.plan.to.si, run.plan.step.si);
  if (!run.motion) return text;
  return text + fmt::format("# speed_m_per_s: {}\n# seed: {}\n# slow_motion: {}\n", run.motion->speed.si,
                            run.motion->seed, run.motion->slow_motion);
}

}  // namespace

std::vector<scene::SourcedValue> acting_sources(const ContactSetup& setup,
                                                std::span<const ContactParameter* const> swept) {
  std::vector<scene::SourcedValue> result = sources_of_numbers(setup, swept);
  // an automatic law may change from one swept value to the next
  if (!swept.empty() && setup.model.automatic) return result;
  const std::string_view publications = physics::source_of(setup.law());
  if (!publications.empty()) {
    result.insert(result.begin(), {"law", setup.used_model(), std::string(publications), false});
  }
  return result;
}

std::string source_line(const scene::SourcedValue& source) {
  return fmt::format("# source of {}: {}, {}{}\n", source.key, source.value, source.source,
                     source.estimated ? " (estimated)" : "");
}

nlohmann::ordered_json sources_json(std::span<const scene::SourcedValue> sources) {
  json result = json::object();
  for (const scene::SourcedValue& source : sources) {
    result[source.key] = {{"value", source.value}, {"source", source.source}, {"estimated", source.estimated}};
  }
  return result;
}

RecordedCurve recorded_curve(const CurveRun& run) {
  RecordedCurve recorded = recorded_curve(run.curve, run.setup.material.contact.spring_constant);
  recorded.metadata.curve_id = run.setup.material.name;
  if (run.motion) recorded.metadata.approach_speed = recorded.metadata.retract_speed = run.motion->speed;
  const std::string header = run_header(run);
  std::string_view line;
  for (Lines lines(header); lines.next(line);) {
    if (!line.starts_with("# software: ")) add_parameter(line.substr(1), recorded.metadata);
  }
  return recorded;
}

std::string setup_header(const ContactSetup& setup, std::span<const ContactParameter* const> swept) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "# model_requested: {}\n# material: {}\n# tip: {}\n# medium: {}\n", setup.model.text,
                 setup.material.name, setup.material.tip, setup.material.medium);
  for (const ContactParameter& parameter : contact_parameters()) {
    const auto value = parameter.get(setup);
    if (!value || !acts(parameter, setup.model) || is_swept(parameter.json_key, swept)) continue;
    fmt::format_to(out, "# {}: {}\n", parameter.json_key, *value);
  }
  if (setup.law_options.exact_hamaker_sphere) fmt::format_to(out, "# exact_hamaker_sphere: true\n");
  for (const scene::SourcedValue& source : acting_sources(setup, swept)) text.append(source_line(source));
  if (!setup.material.note.empty()) fmt::format_to(out, "# note: {}\n", setup.material.note);
  return fmt::to_string(text);
}

std::string setup_header(const ContactSetup& setup, const std::string& model,
                         const std::optional<physics::LawChoice>& place) {
  std::string text = fmt::format("# software: {}\n# model: {}\n", core::written_by(), model);
  if (place) {
    if (setup.model.automatic) text += fmt::format("# law_because: {}\n", place->reason);
    text += fmt::format("# tabor_parameter: {}\n# maugis_lambda: {}\n# regime: {}\n", place->tabor, place->maugis,
                        physics::name_of(place->regime));
  }
  return text + setup_header(setup, {});
}

std::string curve_csv(const CurveRun& run) {
  std::string text =
      fmt::format("# TouchAFM force-displacement curve\n{}# samples: {}\n", run_header(run), run.curve.samples.size());
  text +=
      "# signs: z along the sample's outward normal from its undeformed surface; force on the tip positive away from "
      "the "
      "sample; a jump is two rows at its z\n"
      "z_m,force_N,tip_height_m,deflection_m,sample_deformation_m,branch,phase,event\n";
  // formatting takes longer than the curve, so another core does half of it
  const Samples samples(run.curve.samples);
  const std::size_t half = samples.size() / 2;
  std::string rest;
  auto written = std::async(std::launch::async, append_rows, std::ref(rest), samples.subspan(half));
  text.reserve(text.size() + samples.size() * kRowBytes);
  append_rows(text, samples.first(half));
  written.get();
  text += rest;
  return text;
}

nlohmann::ordered_json parameters_json(const ContactSetup& setup) {
  json result{{"material", setup.material.name}, {"tip", setup.material.tip}, {"medium", setup.material.medium}};
  for (const ContactParameter& parameter : contact_parameters()) {
    const auto value = parameter.get(setup);
    if (value && acts(parameter, setup.model)) result[std::string(parameter.json_key)] = finite_or_null(*value);
  }
  result["exact_hamaker_sphere"] = setup.law_options.exact_hamaker_sphere;
  return result;
}

nlohmann::ordered_json law_json(const ContactSetup& setup, const std::string& model,
                                const std::optional<physics::LawChoice>& place) {
  json result{{"model", model}, {"model_requested", setup.model.text}};
  result["law_because"] = place && setup.model.automatic ? json(place->reason) : json();
  result["tabor_parameter"] = place ? json(place->tabor) : json();
  result["maugis_lambda"] = place ? json(place->maugis) : json();
  result["regime"] = place ? json(physics::name_of(place->regime)) : json();
  return result;
}

void add_sources(nlohmann::ordered_json& result, std::span<const scene::SourcedValue> sources) {
  json estimated = json::array();
  for (const scene::SourcedValue& source : sources) {
    if (source.estimated) estimated.push_back(source.key);
  }
  result["sources"] = sources_json(sources);
  result["estimated"] = std::move(estimated);
}

void add_sources(nlohmann::ordered_json& result, const ContactSetup& setup) {
  add_sources(result, acting_sources(setup));
  core::name_software(result);
}

nlohmann::ordered_json curve_json(const CurveRun& run) {
  json result = law_json(run.setup, run.model, run.place);
  json& parameters = result["parameters"] = parameters_json(run.setup);
  parameters["from_m"] = run.plan.from.si;
  parameters["to_m"] = run.plan.to.si;
  parameters["step_m"] = run.plan.step.si;
  if (run.motion) {
    parameters["speed_m_per_s"] = run.motion->speed.si;
    parameters["seed"] = run.motion->seed;
  }
  result["snap_in"] = snap_in_json(run);
  result["pull_off"] = pull_off_json(run);
  const auto energy = loop_energy(run);
  result["loop_energy_J"] = energy ? json(energy->si + 0.0) : json();
  result["critical_stiffness_N_per_m"] = finite_or_null(run.figures.critical_stiffness.si);
  if (run.motion) result["slow_motion"] = run.motion->slow_motion;
  add_sources(result, run.setup);
  return result;
}

SvgPlot curve_plot(const CurveRun& run) {
  SvgPlot plot;
  plot.title = run.setup.heading();
  plot.about = run_header(run);
  plot.x_label = "piezo displacement Z (nm)";
  plot.y_label = "force on the tip F (nN)";
  SvgLine approach{"approach", std::string(distinct_color(0)), LineStyle::Dashed, {}};
  SvgLine retract{"retract", std::string(distinct_color(0)), LineStyle::Solid, {}};
  for (const auto& sample : run.curve.samples) {
    const bool approaching = sample.branch == physics::Branch::Approach;
    if (!approaching && retract.points.empty() && !approach.points.empty()) {
      retract.points.push_back(approach.points.back());  // turning point, shared by both branches
    }
    (approaching ? approach : retract).points.push_back({sample.z.si * kNmPerM, sample.force.si * kNnPerN});
  }
  plot.lines = {std::move(approach), std::move(retract)};
  for (const physics::ModelEvent& event : run.curve.events) {
    const bool in = event.kind == EventKind::JumpToContact;
    const double force = (in ? event.force_after : event.force_before).si * kNnPerN;
    const std::string text = fmt::format("{}: {:.4g} nm, {}{:.4g} nN", in ? "snap-in" : "pull-off",
                                         event.z.si * kNmPerM, force < 0.0 ? "\u2212" : "", std::abs(force));
    plot.marks.push_back(
        {{event.z.si * kNmPerM, force}, text, "#1d2329", in ? SvgMark::Side::Right : SvgMark::Side::Left});
  }
  return plot;
}

}  // namespace afm::curves
