// SPDX-License-Identifier: Apache-2.0
#include "app/commands/view_map.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "app/options/exhibit_options.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/recorded_map.h"
#include "scene/shared/map_vibration.h"
#include "servo/haptic_choice.h"

namespace afm::app {

namespace {

core::Result<void> check_vibration(const ViewOptions& options) {
  if (options.files.map_vibration == scene::MapVibration::None) return {};
  const auto choice = servo::parse_haptic_choice(options.servo.haptic_device);
  if (!choice) return tl::unexpected(choice.error());
  const bool recorded = !choice->replay_file.empty();
  if (!recorded && (choice->device == nullptr || choice->device->vibrates)) return {};
  std::string others;
  for (const haptics::DeviceKind& kind : haptics::device_kinds()) {
    if (kind.vibrates) others += fmt::format("{}{}", others.empty() ? "" : ", ", kind.word);
  }
  return core::wrong_usage(fmt::format(
      "--map-vibration: the profile of --haptics {} has no vibration; use one of {}, or leave --map-vibration out",
      options.servo.haptic_device, others));
}

}  // namespace

core::Result<void> take_map_options(const ViewOptions& options, curves::TappedHand& tapping,
                                    exhibit::ExhibitFiles& files) {
  if (auto checked = check_vibration(options); !checked) return checked;
  if (files.force_map.empty() || tapping.choice.mode != "contact") return {};
  const std::string text = std::exchange(tapping.values["spring-constant"], {});
  if (text.empty()) return {};
  if (options.cluster.wanted)
    return core::wrong_usage("--spring-constant of a force map does not reach the machines of --cluster; remove one");
  return set_map_spring_constant(text, files);
}

core::Result<void> keep_map(const exhibit::Stage& stage, const exhibit::ExhibitFiles& files, ViewSettings& settings) {
  if (settings.record_folder.empty()) return {};
  auto recorded = exhibit::recorded_map_of(stage, files);
  if (!recorded) return tl::unexpected(recorded.error());
  settings.force_map = std::move(*recorded);
  return {};
}

}  // namespace afm::app
