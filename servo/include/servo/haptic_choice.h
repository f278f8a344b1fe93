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
  const haptics::DeviceKind* device = nullptr;  // kind of device; null: the best available
  std::string replay_file;                      // session whose hand is replayed without a device; empty: none
  enum class Person { Mouse, Simulated };
  Person person = Person::Mouse;  // person who moves a device without a real hand
};

struct HapticWord {
  std::string word;
  std::string meaning;
};

// All values of --haptics: "auto", "mouse", the names in haptics::device_kinds(), and "replay:FILE".
std::vector<HapticWord> haptic_words();

// Parses one of these values; anything else is WrongUsage. For the servo, a mouse is the simulated hand, which the
// window moves.
core::Result<HapticChoice> parse_haptic_choice(std::string_view text);

// Opens the chosen device, in the place that the environment gives. DeviceMissing: it is not connected. BadInputFile:
// the session cannot be replayed. The attempts are logged, unless the simulated hand was requested. `clock` outlives
// the device.
core::Result<haptics::OpenedDevice> open_haptic_device(const HapticChoice& choice, const core::Clock& clock,
                                                       const haptics::OfferReleasePath& offer = {});

// Environment of this process.
haptics::Environment environment();

}  // namespace afm::servo
