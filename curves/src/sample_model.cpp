// SPDX-License-Identifier: Apache-2.0
#include "curves/sample_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "curves/felt_swing.h"
#include "haptics/contact_model.h"
#include "haptics/simulated_device.h"
#include "scene/shared/shared_segment.h"

namespace afm::curves {

namespace {

using physics::Law;

// Parameters for the servo. For a measured law the caller sets the law.
scene::SharedContact parameters_of(const ContactSetup& setup) {
  const physics::LawOptions& options = setup.law_options;
  scene::SharedContact shared;
  shared.name = scene::to_name(setup.material.name);
  shared.contact = setup.material.contact;
  shared.law = setup.law();
  shared.exact_hamaker_sphere = options.exact_hamaker_sphere ? 1 : 0;
  shared.retardation_wavelength_m = options.retardation_wavelength.value_or(physics::Length()).si;
  shared.has_meniscus = options.meniscus ? 1 : 0;
  shared.meniscus = options.meniscus.value_or(physics::Meniscus());
  shared.dynamic = setup.model.dynamic ? 1 : 0;
  shared.lever = setup.material.lever;
  shared.friction = setup.felt_friction();
  if (setup.drive) {
    shared.free_amplitude_m = setup.drive->free_amplitude.si;
    shared.drive_hz = setup.drive->frequency.si;
    shared.viscosity_pa_s = setup.drive->viscosity.si;
    shared.felt_mean_force = setup.drive->mean_force ? 1 : 0;
  }
  return shared;
}

tl::unexpected<core::Error> refusal(const scene::MaterialEntry& entry, core::ErrorCategory category,
                                    std::string_view why) {
  return core::failure(category, fmt::format("{} cannot be felt: {}", entry.name, why));
}

core::Result<SampleModel> model_with(const ContactSetup& setup, const scene::SharedContact& parameters,
                                     std::span<const scene::SharedMeasuredCurve> curves) {
  auto tables = haptics::build_tables(parameters, curves);
  if (!tables) return tl::unexpected(tables.error());
  auto scaling = haptics::Scaling::fit(**tables, haptics::SimulatedDevice().spec());
  if (!scaling) return refusal(setup.material, scaling.error().category, scaling.error().message);
  return SampleModel{setup,   parameters, physics::choose_law(parameters.contact), std::move(*tables), *scaling,
                     nullptr, nullptr};
}

}  // namespace

core::Result<SampleModel> make_sample_model(const ContactSetup& setup) {
  try {
    const scene::SharedContact parameters = parameters_of(setup);
    const std::string why =
        scene::why_no_friction(parameters.friction.law, parameters.law, parameters.contact.reduced_modulus);
    if (!why.empty()) return refusal(setup.material, core::ErrorCategory::WrongUsage, why);
    auto model = model_with(setup, parameters, {});
    if (!model) return model;
    if (const std::string lost = why_swing_is_lost(*model); !lost.empty()) {
      return refusal(setup.material, core::ErrorCategory::WrongUsage, lost);
    }
    return model;
  } catch (const std::invalid_argument& error) {
    return refusal(setup.material, core::ErrorCategory::Failed, error.what());
  }
}

core::Result<SampleModel> make_sample_model(const SampleModel& material, const ContactSetup& changed) {
  auto felt = make_sample_model(changed);
  if (!felt) return felt;
  felt->setup = material.setup;
  felt->parameters.height_field = material.parameters.height_field;
  felt->parameters.topography = material.parameters.topography;
  felt->parameters.surface_release_m = material.parameters.surface_release_m;
  return felt;
}

core::Result<SampleModel> make_sample_model(const scene::MaterialEntry& entry, const scene::SharedContact& parameters,
                                            std::span<const scene::SharedMeasuredCurve> curves) {
  ContactSetup setup{entry, scene::law_options(parameters), {}};
  setup.model.law = parameters.law;
  setup.model.dynamic = parameters.dynamic != 0;
  setup.friction = parameters.friction.law;
  return model_with(setup, parameters, curves);
}

core::Result<SampleModel> make_sample_model(const scene::MaterialEntry& entry,
                                            std::span<const scene::SharedMeasuredCurve> curves, std::uint32_t index) {
  scene::SharedContact parameters = parameters_of(ContactSetup{entry, {}, {}});
  parameters.law = Law::Measured;
  parameters.measured_curve = index;
  return make_sample_model(entry, parameters, curves);
}

std::string law_name(const scene::SharedContact& parameters) {
  const char* lever = parameters.dynamic != 0 ? "dynamic-" : scene::taps(parameters) ? "tapping-" : "";
  return fmt::format("{}{}", lever, physics::name_of(parameters.law));
}

}  // namespace afm::curves
