// SPDX-License-Identifier: Apache-2.0
#include "app/demo/demo_plan.h"

#include <fmt/format.h>

#include <utility>

#include "app/demo/demonstration.h"
#include "core/log.h"
#include "curves/sweep.h"
#include "curves/tapping/driven_setup.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/models/topography_model.h"
#include "scene/samples/probe_library.h"

namespace afm::app {

namespace {

constexpr std::uint64_t kMostVariations = 9;
constexpr double kLeastMeeting = 0.05;  // fraction of the free amplitude below which a swing keeps its state

bool taps(const DemoSamples& samples) { return samples.tapping.choice.mode == "tapping"; }

// A material as it will be felt, with the chosen probe.
core::Result<curves::ContactSetup> setup_of(scene::MaterialEntry entry, const DemoSamples& samples,
                                            const std::string& assets_dir) {
  if (!samples.probe.empty()) {
    const auto probes = scene::load_probes(assets_dir + "/probes.toml");
    if (!probes) return tl::unexpected(probes.error());
    const auto probe = probes->require(samples.probe);
    if (!probe) return tl::unexpected(probe.error());
    entry = scene::with_probe(std::move(entry), **probe);
  }
  if (taps(samples)) return curves::tapped_setup(entry, samples.tapping);
  return curves::ContactSetup{std::move(entry), {}, samples.model, samples.friction};
}

// Checks that the lever reaches the repulsive state, for which a hand waits before it turns back.
core::Result<void> check_state(const curves::SampleModel& material) {
  const physics::CycleFigures& figures = material.figures();
  const double a0_m = material.parameters.free_amplitude_m;
  if (figures.hysteretic || figures.z_jtc.si > kLeastMeeting * a0_m) return {};
  return core::wrong_usage(
      fmt::format("{}: the swing stays in the attractive state on the way down; give a larger --free-amplitude or "
                  "--spring-constant",
                  material.setup.material.name));
}

// Copies of the material, one for each value of each varied parameter; the value is in the title.
core::Result<std::vector<curves::SampleModel>> variations_of(const curves::SampleModel& material,
                                                             const DemoSamples& samples) {
  std::vector<curves::SampleModel> variations;
  for (const std::string& text : samples.vary) {
    const auto axis = curves::parse_sweep_axis(text, samples.model);
    if (!axis) return core::failure(axis.error().category, "--vary " + axis.error().message);
    if (axis->count > kMostVariations) {
      return core::failure(core::ErrorCategory::WrongUsage,
                           fmt::format("--vary: {} values; give 2 to {}", axis->count, kMostVariations));
    }
    for (std::uint64_t i = 0; i < axis->count; ++i) {
      const std::string value = curves::format_parameter(*axis->parameter, axis->value(i));
      curves::ContactSetup changed = material.setup;
      curves::override_parameter(changed, *axis->parameter, axis->value(i), value, "--vary on the command line");
      auto varied = curves::make_sample_model(material, changed);
      if (!varied) return tl::unexpected(varied.error());
      varied->setup.material.title = fmt::format("{} {}", material.setup.material.title, value);
      variations.push_back(std::move(*varied));
    }
  }
  return variations;
}

}  // namespace

core::Result<std::optional<curves::MeasuredMaterial>> load_measured(const DemoSamples& samples,
                                                                    const std::string& assets_dir) {
  if (samples.measured.empty()) return std::nullopt;
  const auto library = scene::load_materials(assets_dir + "/materials.toml");
  if (!library) return tl::unexpected(library.error());
  auto measured = curves::load_measured_material(samples.measured, library->materials.front());
  if (!measured) return tl::unexpected(measured.error());
  return std::move(*measured);
}

core::Result<DemoPlan> plan_demo(const exhibit::Stage& stage, const std::optional<curves::MeasuredMaterial>& measured,
                                 const DemoSamples& samples, const std::string& assets_dir) {
  DemoPlan plan;
  plan.scale = samples.scale.value_or(plan.scale);
  if (measured) {
    plan.curves.push_back(measured->curve);
    plan.recorded = measured->features;
  }
  for (const scene::MaterialEntry& entry : stage.materials.materials) {
    if (measured && entry.name == measured->entry.name) {
      auto model = curves::make_sample_model(entry, plan.curves, 0);
      if (!model) return tl::unexpected(model.error());
      stage.wall_scene.lay_surface_on(model->parameters, plan.materials.size());
      plan.materials.push_back(std::move(*model));
      plan.variations.emplace_back();
      continue;
    }
    const auto setup = setup_of(entry, samples, assets_dir);
    if (!setup) return tl::unexpected(setup.error());
    auto model = curves::make_sample_model(*setup);
    if (!model) return tl::unexpected(model.error());
    if (taps(samples)) {
      if (auto checked = check_state(*model); !checked) return tl::unexpected(checked.error());
    }
    stage.wall_scene.lay_surface_on(model->parameters, plan.materials.size());
    if (stage.wall_scene.topography().columns > 0) {
      core::log_line(exhibit::smoothing_note(*model, stage.wall_scene.topography()));
    }
    auto variations = variations_of(*model, samples);
    if (!variations) return tl::unexpected(variations.error());
    plan.materials.push_back(std::move(*model));
    plan.variations.push_back(std::move(*variations));
  }
  return plan;
}

}  // namespace afm::app
