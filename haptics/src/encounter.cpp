// SPDX-License-Identifier: Apache-2.0
#include "haptics/encounter.h"

#include <fmt/core.h>

#include <cstring>
#include <exception>
#include <string>

#include "scene/shared_segment.h"

namespace afm::haptics {

namespace {

tl::unexpected<core::Error> refusal(const scene::SharedMaterial& material, const core::Error& why) {
  // a name that came without its end is cut
  const std::string name(material.name.data(), ::strnlen(material.name.data(), material.name.size()));
  return core::failure(why.category, fmt::format("cannot make {} felt: {}", name, why.message));
}

}  // namespace

core::Result<std::unique_ptr<Encounter>> Encounter::create(const scene::SharedMaterial& material,
                                                           std::uint32_t edit_revision,
                                                           std::span<const scene::SharedMeasuredCurve> curves,
                                                           const DeviceSpec& device) {
  if (auto valid = scene::validate(material, static_cast<std::uint32_t>(curves.size())); !valid) {
    return refusal(material, valid.error());
  }
  try {
    const physics::ApproachRetractModel model(material.interaction);
    auto scaling = FitScaling::create(model.figures(), device);
    if (!scaling) return refusal(material, scaling.error());
    return std::unique_ptr<Encounter>(new Encounter(model, *scaling, edit_revision));
  } catch (const std::exception& error) {
    return refusal(material, {core::ErrorCategory::Failed, error.what()});
  }
}

}  // namespace afm::haptics
