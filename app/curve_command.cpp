// SPDX-License-Identifier: Apache-2.0
#include "app/curve_command.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "app/command.h"
#include "app/whole_file.h"
#include "core/log.h"
#include "physics/contact.h"
#include "physics/curve_analysis.h"
#include "physics/quantity_text.h"

namespace afm::app {
namespace {

using physics::Infinity;

tl::unexpected<core::Error> wrong_usage(std::string message) {
  return core::failure(core::ErrorCategory::WrongUsage, std::move(message));
}

template <class Q>
core::Result<Q> parse_option(const std::string& option, const std::string& text, const physics::UnitList<Q>& units,
                             Infinity infinity = Infinity::Refused) {
  const auto parsed = physics::parse_quantity(text, units, infinity);
  if (!parsed.value) return wrong_usage(option + ": " + parsed.error);
  return *parsed.value;
}

// Replaces one of the material's numbers by what the option says, if it was given, and says so in its source.
template <class Q>
core::Result<void> override_value(scene::MaterialEntry& material, const std::string& option, const std::string& text,
                                  const char* key, Q& value, const physics::UnitList<Q>& units, double factor,
                                  Infinity infinity) {
  if (text.empty()) return {};
  const auto parsed = parse_option(option, text, units, infinity);
  if (!parsed) return tl::unexpected(parsed.error());
  value = factor * *parsed;
  for (auto& sourced : material.sources) {
    if (sourced.key == key) sourced = {key, text, option + " on the command line"};
  }
  return {};
}

core::Result<void> apply_overrides(const CurveOptions& options, scene::MaterialEntry& material) {
  physics::Interaction& interaction = material.interaction;
  core::Result<void> done;
  const auto take = [&](const char* option, const std::string& text, const char* key, auto& value, const auto& units,
                        double factor = 1.0, Infinity infinity = Infinity::Refused) {
    if (done) done = override_value(material, option, text, key, value, units, factor, infinity);
  };
  take("--tip-radius", options.tip_radius, "tip_radius", interaction.tip_radius, physics::kLengthUnits);
  take("--spring-constant", options.spring_constant, "spring_constant", interaction.spring_constant,
       physics::kStiffnessUnits);
  take("--sample-stiffness", options.sample_stiffness, "sample_stiffness", interaction.sample_stiffness,
       physics::kStiffnessUnits, 1.0, Infinity::Allowed);
  take("--hamaker", options.hamaker, "hamaker", interaction.hamaker, physics::kEnergyUnits);
  // W_ad = 2 sqrt(gamma_s gamma_t) (3.3)
  take("--work-of-adhesion", options.work_of_adhesion, "mean_surface_energy", interaction.mean_surface_energy,
       physics::kSurfaceEnergyUnits, 0.5);
  return done;
}

core::Result<physics::SweepPlan> sweep_plan(const CurveOptions& options, physics::Length z_joc) {
  physics::SweepPlan plan;
  if (options.from.empty()) {
    plan.from = physics::Length(std::ceil(1.1 * z_joc.si * 1e9) / 1e9);
  } else {
    const auto from = parse_option("--from", options.from, physics::kLengthUnits);
    if (!from) return tl::unexpected(from.error());
    plan.from = *from;
  }
  const auto to = parse_option("--to", options.to, physics::kLengthUnits);
  if (!to) return tl::unexpected(to.error());
  const auto step = parse_option("--step", options.step, physics::kLengthUnits);
  if (!step) return tl::unexpected(step.error());
  plan.to = *to;
  plan.step = *step;
  return plan;
}

core::Result<physics::ForceCurve> sweep(const std::string& model, const physics::Interaction& interaction,
                                        const physics::SweepPlan& plan) {
  if (model == "paper") return physics::record_curve(physics::ApproachRetractModel(interaction), plan);
  if (model == "paper-rule") return physics::record_curve(physics::DirectionRuleModel(interaction), plan);
  return wrong_usage(fmt::format("unknown model \"{}\"; known are paper, paper-rule", model));
}

const physics::ModelEvent* find_event(const physics::ForceCurve& curve, physics::EventKind kind) {
  for (const auto& event : curve.events) {
    if (event.kind == kind) return &event;
  }
  return nullptr;
}

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

const char* name_of(std::optional<physics::EventKind> event) {
  if (!event) return "";
  return *event == physics::EventKind::JumpToContact ? "jump_to_contact" : "jump_off_contact";
}

core::Result<void> write_stdout(const std::string& text) {
  errno = 0;
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written || std::fflush(stdout) != 0) {
    return core::failure(core::ErrorCategory::Failed, fmt::format("cannot write to stdout: {}", std::strerror(errno)));
  }
  return {};
}

core::Result<void> print_curve(const CurveOptions& options) {
  const auto run = run_curve(options);
  if (!run) return tl::unexpected(run.error());
  if (!run->curve.samples.empty() && run->curve.samples.back().phase == physics::Phase::Attached) {
    core::log_line(
        "the sweep ends below jump-off-contact, with the tip still attached; raise --from to close the loop");
  }
  const std::string text = options.json ? curve_json(*run).dump(2) + "\n" : curve_csv(*run);
  return options.out.empty() ? write_stdout(text) : write_file(options.out, text);
}

}  // namespace

core::Result<CurveRun> run_curve(const CurveOptions& options) {
  const auto library = scene::load_materials(options.materials_file);
  if (!library) return tl::unexpected(library.error());
  const auto found = library->require(options.material);
  if (!found) return tl::unexpected(found.error());

  CurveRun run{options.model, **found, {}, {}};
  if (const auto applied = apply_overrides(options, run.material); !applied) return tl::unexpected(applied.error());
  try {
    const auto events = physics::approach_retract_events(run.material.interaction);
    const auto plan = sweep_plan(options, events.z_joc);
    if (!plan) return tl::unexpected(plan.error());
    run.plan = *plan;
    auto curve = sweep(options.model, run.material.interaction, run.plan);
    if (!curve) return tl::unexpected(curve.error());
    run.curve = std::move(*curve);
  } catch (const std::invalid_argument& error) {
    return wrong_usage(error.what());
  }
  return run;
}

std::string curve_csv(const CurveRun& run) {
  const physics::Interaction& in = run.material.interaction;
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "# TouchAFM force-displacement curve\n# model: {}\n# material: {}\n# tip: {}\n# medium: {}\n"
                 "# tip_radius_m: {}\n# spring_constant_N_per_m: {}\n# sample_stiffness_N_per_m: {}\n# hamaker_J: {}\n"
                 "# work_of_adhesion_J_per_m2: {}\n# from_m: {}\n# to_m: {}\n# step_m: {}\n",
                 run.model, run.material.name, run.material.tip, run.material.medium, in.tip_radius.si,
                 in.spring_constant.si, in.sample_stiffness.si, in.hamaker.si, 2.0 * in.mean_surface_energy.si,
                 run.plan.from.si, run.plan.to.si, run.plan.step.si);
  for (const auto& sourced : run.material.sources) {
    if (sourced.key.starts_with("experiment")) continue;
    fmt::format_to(out, "# source of {}: {}, {}\n", sourced.key, sourced.value, sourced.source);
  }
  if (!run.material.note.empty()) fmt::format_to(out, "# note: {}\n", run.material.note);
  fmt::format_to(out,
                 "# signs: z along the sample's outward normal from its undeformed surface; force on the tip positive "
                 "away from the sample; a jump is two rows at its z\n"
                 "z_m,force_N,tip_height_m,deflection_m,sample_deformation_m,branch,phase,event\n");
  for (const auto& s : run.curve.samples) {
    // adding zero turns -0 into 0
    fmt::format_to(out, "{},{},{},{},{},{},{},{}\n", s.z.si + 0.0, s.force.si + 0.0, s.tip_height.si + 0.0,
                   s.cantilever_deflection.si + 0.0, s.sample_deformation.si + 0.0,
                   s.branch == physics::Branch::Approach ? "approach" : "retract", name_of(s.phase), name_of(s.event));
  }
  return fmt::to_string(text);
}

nlohmann::ordered_json curve_json(const CurveRun& run) {
  using json = nlohmann::ordered_json;
  const physics::Interaction& in = run.material.interaction;
  json result{
      {"model", run.model},
      {"parameters",
       {{"material", run.material.name},
        {"tip_radius_m", in.tip_radius.si},
        {"spring_constant_N_per_m", in.spring_constant.si},
        {"sample_stiffness_N_per_m", std::isinf(in.sample_stiffness.si) ? json() : json(in.sample_stiffness.si)},
        {"hamaker_J", in.hamaker.si},
        {"work_of_adhesion_J_per_m2", 2.0 * in.mean_surface_energy.si},
        {"from_m", run.plan.from.si},
        {"to_m", run.plan.to.si},
        {"step_m", run.plan.step.si}}},
      {"snap_in", nullptr},
      {"pull_off", nullptr},
      {"loop_energy_J", nullptr},
      // the paper's model has no modulus, hence neither
      {"tabor_parameter", nullptr},
      {"regime", nullptr}};
  if (const auto* event = find_event(run.curve, physics::EventKind::JumpToContact)) {
    result["snap_in"] = {{"z_m", event->z.si},
                         {"force_before_N", event->force_before.si + 0.0},
                         {"force_after_N", event->force_after.si + 0.0}};
  }
  if (const auto* event = find_event(run.curve, physics::EventKind::JumpOffContact)) {
    result["pull_off"] = {{"z_m", event->z.si}, {"force_N", event->force_before.si + 0.0}};
  }
  if (run.curve.samples.front().force == run.curve.samples.back().force) {
    result["loop_energy_J"] = physics::summarise(run.curve.samples).loop_energy.si;
  }
  return result;
}

void add_curve_command(CLI::App& app, CommandContext& context) {
  CLI::App* command = app.add_subcommand("curve", "one approach-retract cycle as CSV, or its events as JSON");
  // shared: the parser writes into it while it lives, the chosen command reads it afterwards
  const auto options = std::make_shared<CurveOptions>();
  command->add_option("--material", options->material, "mica, gold, si3n4, or another of the material file")
      ->required();
  command->add_option("--model", options->model, "paper: the two-state latch; paper-rule: the flow chart, to compare")
      ->check(CLI::IsMember({"paper", "paper-rule"}))
      ->capture_default_str();
  command->add_option("--from", options->from,
                      "where the cycle starts and ends, above Z_jtc: m, mm, um, nm, pm; "
                      "default: a tenth above Z_joc");
  command->add_option("--to", options->to, "where it turns, below --from: m, mm, um, nm, pm")->capture_default_str();
  command->add_option("--step", options->step, "between samples: m, mm, um, nm, pm; at most 10 million samples")
      ->capture_default_str();
  command->add_option("--tip-radius", options->tip_radius, "R, 0.1nm to 1mm: m, mm, um, nm, pm");
  command->add_option("--spring-constant", options->spring_constant, "k_c, 1e-6N/m to 1e6N/m: N/m, mN/m");
  command->add_option("--sample-stiffness", options->sample_stiffness, "k_s, 1e-6N/m to \"inf N/m\": N/m, mN/m");
  command->add_option("--hamaker", options->hamaker, "A_H, 1e-24J to 1e-16J: J, aJ, zJ");
  command->add_option("--work-of-adhesion", options->work_of_adhesion,
                      "W_ad = 2 sqrt(gamma_s gamma_t), 2e-9J/m2 to 200J/m2: J/m2, mJ/m2");
  command->add_option("--materials", options->materials_file, "material file (TOML); default: the built-in one");
  command->add_flag("--json", options->json, "the events instead of the samples, in SI");
  command->add_option("--out", options->out, "write here instead of to stdout");
  command->footer(
      "Each parameter overrides the material's.\n"
      "example: touchafm curve --material mica --spring-constant 0.2N/m --from 20nm --to -5nm --out mica.csv");
  command->callback([options, &context] {
    if (options->materials_file.empty()) options->materials_file = context.assets_dir + "/materials.toml";
    context.chosen = [options] { return print_curve(*options); };
  });
}

}  // namespace afm::app
