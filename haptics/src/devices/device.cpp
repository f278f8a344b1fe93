// SPDX-License-Identifier: Apache-2.0
#include "haptics/device.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace afm::haptics {

namespace {
constexpr double kDefaultCapN = 2.0;
constexpr double kUsableShare = 0.9;
constexpr double kFarthestM = 1e3;
}  // namespace

// Profile with force and stability from the vendor's data sheet and CHAI3D's table.
DeviceSpec omni_like(std::string name) {
  return {.name = std::move(name),
          .max_force_n = 3.3,
          .max_continuous_force_n = 0.88,
          .max_stiffness_n_per_m = 700.0,
          .workspace_min_m = glm::dvec3(-0.080, -0.040, -0.035),
          .workspace_max_m = glm::dvec3(0.080, 0.080, 0.035),
          .contact_point_m = glm::dvec3(0.0)};
}

DeviceSpec from_contact(DeviceSpec spec) {
  spec.workspace_min_m -= spec.contact_point_m;
  spec.workspace_max_m -= spec.contact_point_m;
  spec.contact_point_m = glm::dvec3(0.0);
  return spec;
}

scene::SharedDevice shared(const DeviceSpec& spec) {
  const DeviceSpec here = from_contact(spec);
  return {.name = scene::to_name(here.name),
          .max_force_n = here.max_force_n,
          .max_continuous_force_n = here.max_continuous_force_n,
          .max_stiffness_n_per_m = here.max_stiffness_n_per_m,
          .max_slew_n_per_s = here.max_slew_n_per_s,
          .max_speed_m_per_s = here.max_speed_m_per_s,
          .max_vibration_n = here.max_vibration_n,
          .has_own_hand = here.has_own_hand ? 1U : 0U,
          .workspace_min_m = {here.workspace_min_m.x, here.workspace_min_m.y, here.workspace_min_m.z},
          .workspace_max_m = {here.workspace_max_m.x, here.workspace_max_m.y, here.workspace_max_m.z}};
}

DeviceSpec spec_of(const scene::SharedDevice& device) {
  const auto& [min_x, min_y, min_z] = device.workspace_min_m;
  const auto& [max_x, max_y, max_z] = device.workspace_max_m;
  return {.name = std::string(device.name.data()),
          .max_force_n = device.max_force_n,
          .max_continuous_force_n = device.max_continuous_force_n,
          .max_stiffness_n_per_m = device.max_stiffness_n_per_m,
          .max_slew_n_per_s = device.max_slew_n_per_s,
          .max_speed_m_per_s = device.max_speed_m_per_s,
          .max_vibration_n = device.max_vibration_n,
          .has_own_hand = device.has_own_hand != 0,
          .workspace_min_m = glm::dvec3(min_x, min_y, min_z),
          .workspace_max_m = glm::dvec3(max_x, max_y, max_z),
          .contact_point_m = glm::dvec3(0.0)};
}

double force_cap_n(const DeviceSpec& spec) { return std::min(kDefaultCapN, kUsableShare * spec.max_force_n); }

DeviceSpec limited_to(DeviceSpec spec, double max_n) {
  spec.max_force_n = std::min(spec.max_force_n, max_n / kUsableShare);
  // corrects a division that was rounded up
  while (force_cap_n(spec) > max_n) spec.max_force_n = std::nextafter(spec.max_force_n, 0.0);
  return spec;
}

double usable_slew_n_per_s(const DeviceSpec& spec, double wanted_n_per_s) {
  return std::min(wanted_n_per_s, kUsableLimitShare * spec.max_slew_n_per_s);
}

bool is_within_reach(const glm::dvec3& position_m) noexcept {
  // NaN compares false
  return std::abs(position_m.x) <= kFarthestM && std::abs(position_m.y) <= kFarthestM &&
         std::abs(position_m.z) <= kFarthestM;
}

}  // namespace afm::haptics
