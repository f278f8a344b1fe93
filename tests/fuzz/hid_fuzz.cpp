// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include "fuzz/accepted.h"
#include "input/dualsense.h"
#include "input/hid_mapping.h"
#include "input/hid_wand.h"
#include "input/joycon.h"
#include "input/psmove.h"
#include "input/spacemouse.h"
#include "input/wiimote.h"

namespace {

using namespace afm::input;

std::unique_ptr<HidDriver> driver(unsigned family) {
  HidMapping mapping;
  switch (family % 8) {
    case 0:
      return spacemouse_driver();
    case 1:
      return wiimote_driver();
    case 2:
      return psmove_driver(PsMoveModel::Zcm1);
    case 3:
      return psmove_driver(PsMoveModel::Zcm2);
    case 4:
      return dualsense_driver();
    case 5:
      return joycon_driver(JoyConSide::Left);
    case 6:
      return joycon_driver(JoyConSide::Right);
    default:
      mapping.axes.push_back({.quantity = HidMapping::Quantity::Gyro, .byte = 1, .bit = 3, .bits = 32});
      mapping.axes.push_back({.quantity = HidMapping::Quantity::Acceleration, .axis = 1, .byte = 5, .bits = 1});
      mapping.buttons.push_back({.byte = 7, .bit = 7});
      return mapped_driver(mapping);
  }
}

}  // namespace

// The first byte names the device's family, then come reports, each behind its length; the first is its calibration.
// Whatever they are: a wand that points along a unit vector, or nowhere.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size == 0) return 0;
  auto device = driver(bytes[0]);
  std::vector<std::vector<std::uint8_t>> reports;
  for (std::size_t at = 1; at < size;) {
    const std::size_t length = std::min<std::size_t>(bytes[at], size - at - 1);
    reports.emplace_back(bytes + at + 1, bytes + at + 1 + length);
    at += 1 + length;
  }
  if (!reports.empty()) device->calibrate(std::span(reports).first(1));
  HidWand wand(std::move(device), HandPlace{});
  std::int64_t now_ns = 1'000'000'000;
  for (const auto& report : reports) {
    wand.take(report, now_ns += 4'000'000);
    for (const auto& answer : wand.take_answers()) {
      if (answer.empty()) std::abort();
    }
    const WandState state = wand.state(now_ns);
    if (state.connected) ++afm::fuzz::accepted_inputs;
    const glm::dvec3 d = ray_of(state).direction;
    if (!(std::abs(d.x * d.x + d.y * d.y + d.z * d.z - 1.0) < 1e-6)) std::abort();
    if (!(std::abs(state.push.x) <= 1.0 && std::abs(state.turn.y) <= 1.0)) std::abort();
  }
  return 0;
}
