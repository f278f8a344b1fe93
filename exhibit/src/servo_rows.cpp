// SPDX-License-Identifier: Apache-2.0
#include "exhibit/servo_rows.h"
#include "core/percentiles.h"

#include <fmt/format.h>

#include <string>

namespace afm::exhibit {

namespace {

constexpr double kWarmEnoughToTell = 0.5;

}  // namespace

std::string scale_text(scene::ScaleMode mode) {
  const scene::ScaleModeText& text = scene::text_of(mode);
  return fmt::format("{}: {}", text.word, text.meaning);
}

std::vector<render::DataRow> servo_rows(const scene::TipState& tip, const scene::ServoTiming& timing,
                                        const scene::SharedDevice& device) {
  std::vector<render::DataRow> rows;
  // metres and newtons of the hand for those of the nanoworld: mm per nm, N per nN
  const scene::HandScale& scale = tip.active.scale;
  if (scale.hand_m_per_m > 0) {
    rows.push_back({"Scale of the hand",
                    fmt::format("{:.3g} mm/nm, {:.3g} N/nN", scale.hand_m_per_m * 1e-6, scale.hand_n_per_n * 1e-9),
                    scale_text(tip.active.scale_mode)});
  }
  rows.push_back({"Force at most",
                  fmt::format("{:.2g} N, {:.0f} N/s", tip.safety.force_cap_n, tip.safety.slew_limit_n_per_s),
                  std::string(device.name.data()) + (tip.dead_man != 0 ? ", only while Turn-On is held" : "")});
  if (timing.ticks > 0) {
    rows.push_back({"Servo",
                    fmt::format("{:.0f} Hz, {}", timing.rate_hz, tip.realtime != 0 ? "real-time" : "not real-time"),
                    fmt::format("wakes late by p99 {:.0f} \u00b5s, {} of {} ticks missed",
                                core::percentiles(timing.wake_us, timing.wake_max_us).p99, timing.missed,
                                timing.ticks + timing.missed)});
  }
  if (tip.safety.motor_heat > kWarmEnoughToTell) {
    rows.push_back({"Motors", fmt::format("{:.0f} % warm", 100.0 * tip.safety.motor_heat),
                    fmt::format("force at {:.0f} %", 100.0 * tip.safety.thermal_gain)});
  }
  return rows;
}

}  // namespace afm::exhibit
