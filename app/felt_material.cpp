// SPDX-License-Identifier: Apache-2.0
#include "app/felt_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "haptics/encounter.h"
#include "haptics/simulated_device.h"
#include "scene/shared_segment.h"

namespace afm::app {

namespace {

using physics::Law;

// What the servo gets, but for the law itself.
scene::SharedMaterial parameters_of(const scene::MaterialEntry& entry, const LawRequest& request) {
  scene::SharedMaterial shared;
  // names are for people; a longer one is cut
  std::copy_n(entry.name.begin(), std::min(entry.name.size(), shared.name.size() - 1), shared.name.begin());
  shared.interaction = entry.interaction;
  shared.exact_hamaker_sphere = request.options.exact_hamaker_sphere ? 1 : 0;
  shared.retardation_wavelength_m = request.options.retardation_wavelength.value_or(physics::Length()).si;
  shared.has_meniscus = request.options.meniscus ? 1 : 0;
  shared.meniscus = request.options.meniscus.value_or(physics::Meniscus());
  shared.dynamic = request.dynamic ? 1 : 0;
  shared.lever = entry.lever;
  return shared;
}

core::Result<FeltMaterial> felt(const scene::MaterialEntry& entry, const LawRequest& request,
                                scene::SharedMaterial parameters, std::span<const scene::SharedMeasuredCurve> curves) {
  physics::LawChoice contact;
  try {
    contact = physics::choose_law(parameters.interaction);
  } catch (const std::invalid_argument& error) {
    return core::failure(core::ErrorCategory::Failed, fmt::format("cannot make {} felt: {}", entry.name, error.what()));
  }
  parameters.law = request.law.value_or(contact.law);
  auto tables = haptics::felt_tables(parameters, curves);
  if (!tables) return tl::unexpected(tables.error());
  auto scaling = haptics::FitScaling::create(**tables, haptics::SimulatedDevice().spec());
  if (!scaling) {
    return core::failure(scaling.error().category,
                         fmt::format("cannot make {} felt: {}", entry.name, scaling.error().message));
  }
  return FeltMaterial{entry, request, parameters, contact, std::move(*tables), *scaling};
}

}  // namespace

core::Result<FeltMaterial> felt_material(const scene::MaterialEntry& entry, const LawRequest& request) {
  return felt(entry, request, parameters_of(entry, request), {});
}

core::Result<FeltMaterial> felt_material(const FeltMaterial& material, const physics::Interaction& interaction) {
  scene::SharedMaterial parameters = material.parameters;
  parameters.interaction = interaction;
  return felt(material.entry, material.request, parameters, {});
}

core::Result<FeltMaterial> felt_material(const scene::MaterialEntry& entry, const scene::SharedMaterial& parameters,
                                         std::span<const scene::SharedMeasuredCurve> curves) {
  const LawRequest request{
      .law = parameters.law, .dynamic = parameters.dynamic != 0, .options = scene::law_options(parameters)};
  return felt(entry, request, parameters, curves);
}

core::Result<FeltMaterial> felt_material(const scene::MaterialEntry& entry,
                                         std::span<const scene::SharedMeasuredCurve> curves, std::uint32_t index) {
  const LawRequest request{.law = Law::Measured, .dynamic = false, .options = {}};
  scene::SharedMaterial parameters = parameters_of(entry, request);
  parameters.measured_curve = index;
  return felt(entry, request, parameters, curves);
}

core::Result<std::vector<FeltMaterial>> felt_materials(const scene::MaterialLibrary& library,
                                                       const LawRequest& request) {
  std::vector<FeltMaterial> materials;
  for (const scene::MaterialEntry& entry : library.materials) {
    auto material = felt_material(entry, request);
    if (!material) return tl::unexpected(material.error());
    materials.push_back(std::move(*material));
  }
  return materials;
}

std::string law_name(const scene::SharedMaterial& parameters) {
  return name_of(LawRequest{.law = parameters.law, .dynamic = parameters.dynamic != 0, .options = {}});
}

std::string law_reason(const FeltMaterial& material) {
  const Law law = material.parameters.law;
  if (law == Law::Measured) return "as an instrument recorded it";
  const std::string place = fmt::format("Tabor parameter {:.2g}, regime {}", material.contact.tabor,
                                        physics::name_of(material.contact.regime));
  if (law == material.contact.law) return place + ": it suits";
  return fmt::format("{}: {} would suit", place, physics::name_of(material.contact.law));
}

}  // namespace afm::app
