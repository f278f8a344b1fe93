// SPDX-License-Identifier: Apache-2.0
#include "servo/haptic_choice.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <system_error>
#include <utility>
#include <vector>

#include "core/log.h"
#include "haptics/recorded_device.h"
#include "servo/session_file.h"

namespace afm::servo {

namespace {

constexpr std::string_view kReplay = "replay:";

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

void log_probe(const std::vector<haptics::ProbeLine>& lines) {
  for (const haptics::ProbeLine& line : lines) core::log_line(fmt::format("haptics: {}: {}", line.subject, line.said));
  core::log_line(fmt::format("haptics: the {} is taken", lines.back().subject));
}

core::Result<haptics::OpenedDevice> open_recording(const std::string& file) {
  const auto session = load_session(file);
  if (!session) return tl::unexpected(session.error());
  std::vector<haptics::RecordedHand> hand;
  hand.reserve(session->samples.size());
  for (const scene::TipSample& sample : session->samples) {
    const auto& [x, y, z] = sample.hand_from_contact_m;
    hand.push_back({.from_contact_m = glm::dvec3(x, y, z), .turn_on = sample.turn_on != 0});
  }
  auto device = haptics::RecordedDevice::create(file, std::move(hand));
  if (!device) return tl::unexpected(device.error());
  haptics::OpenedDevice opened;
  opened.lines.push_back({"replay", true, fmt::format("{}, {} ticks", file, session->samples.size())});
  opened.device = std::move(*device);
  log_probe(opened.lines);
  return opened;
}

}  // namespace

core::Result<HapticChoice> parse_haptic_choice(std::string_view text) {
  if (text == "auto") return HapticChoice{haptics::DeviceChoice::Auto, {}};
  if (text == "sim" || text == "mouse") return HapticChoice{haptics::DeviceChoice::Simulated, {}};
  if (text == "hdapi") return HapticChoice{haptics::DeviceChoice::Hdapi, {}};
  if (text == "haply") return HapticChoice{haptics::DeviceChoice::Haply, {}};
  if (text == "gamepad") return HapticChoice{haptics::DeviceChoice::Gamepad, {}};
  if (text.starts_with(kReplay) && text.size() > kReplay.size()) {
    return HapticChoice{haptics::DeviceChoice::Simulated, std::string(text.substr(kReplay.size()))};
  }
  return core::failure(
      core::ErrorCategory::WrongUsage,
      fmt::format("there is no haptic device \"{}\": choose auto, sim, mouse, hdapi, haply, gamepad or replay:FILE",
                  text));
}

core::Result<haptics::OpenedDevice> open_haptic_device(const HapticChoice& choice, const core::Clock& clock) {
  if (!choice.replay_file.empty()) return open_recording(choice.replay_file);
  auto opened = haptics::open_device(choice.device, probe_settings(), clock);
  if (opened && choice.device != haptics::DeviceChoice::Simulated) log_probe(opened->lines);
  return opened;
}

haptics::ProbeSettings probe_settings() {
  haptics::ProbeSettings settings{.hd_library = variable(haptics::kHdLibraryVariable),
                                  .hd_device = variable(haptics::kHdDeviceVariable)};
  const std::string port = variable(haptics::kHaplyPortVariable);
  std::uint16_t number = 0;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
  if (error == std::errc() && end == port.data() + port.size() && number > 0) {
    settings.haply_port = number;
  } else if (!port.empty()) {
    core::log_line(fmt::format("{}: \"{}\" is no port, 1 to 65535: {} is used", haptics::kHaplyPortVariable, port,
                               settings.haply_port));
  }
  return settings;
}

}  // namespace afm::servo
