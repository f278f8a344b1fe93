// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "haptics/device_registry.h"

// Values of --haptics and their devices.
namespace afm::servo {

struct HapticChoice {
  const haptics::DeviceKind* device = nullptr;  // null: the best there is
  std::string replay_file;                      // not empty: a session whose hand is played, and no device
  enum class Person { Mouse, Simulated };
  Person person = Person::Mouse;  // moves a device that no real hand moves
};

struct HapticWord {
  std::string word;
  std::string meaning;
};

// All that --haptics takes: "auto", "mouse", the words of haptics::device_kinds(), and "replay:FILE".
std::vector<HapticWord> haptic_words();

// One of those; anything else is wrong usage. A mouse is for the servo the simulated hand, which the window moves.
core::Result<HapticChoice> parse_haptic_choice(std::string_view text);

// Opens it, where the environment says. DeviceMissing: it is not there. BadInputFile: the session cannot be played.
// What was tried goes to the log, unless the simulated hand was asked for. `clock` outlives the device.
core::Result<haptics::OpenedDevice> open_haptic_device(const HapticChoice& choice, const core::Clock& clock,
                                                       const haptics::OfferReleasePath& offer = {});

// That of this process.
haptics::Environment environment();

}  // namespace afm::servo
