// SPDX-License-Identifier: Apache-2.0
#include "exhibit/panels/servo_rows.h"

#include <fmt/format.h>

#include <string>

#include "core/enumerators.h"
#include "core/percentiles.h"

namespace afm::exhibit {

namespace {

constexpr double kWarmEnoughToShow = 0.5;
static_assert(after(Phrase::ScaleCommon, scene::kScaleModes.size()) == Phrase::ForceLimit);

}  // namespace

std::vector<render::DataRow> servo_rows(const scene::TipState& tip, const scene::ServoTiming& timing,
                                        const scene::SharedDevice& device, const Phrases& phrases) {
  using enum Phrase;
  std::vector<render::DataRow> rows;
  // metres and newtons of the hand per those of the nanoworld: mm per nm, N per nN
  const scene::HandScale& scale = tip.active.scale;
  if (scale.hand_m_per_m > 0) {
    rows.push_back(
        {phrases[HandScale],
         phrases.number(fmt::format("{:.3g} mm/nm, {:.3g} N/nN", scale.hand_m_per_m * 1e-6, scale.hand_n_per_n * 1e-9)),
         phrases[after(ScaleCommon, core::index_of(tip.active.scale_mode))]});
  }
  const std::string name = phrases.word(device.name.data());
  rows.push_back(
      {phrases[ForceLimit],
       phrases.number(fmt::format("{:.2g} N, {:.0f} N/s", tip.safety.force_cap_n, tip.safety.slew_limit_n_per_s)),
       tip.dead_man != 0 ? phrases.text<WhileTurnOnHeld>(name) : name});
  if (timing.ticks > 0) {
    const double late_us = core::percentiles(timing.wake_us, timing.wake_max_us).p99;
    rows.push_back({phrases[Servo],
                    phrases.text<ServoRate>(fmt::format("{:.0f}", timing.rate_hz),
                                            phrases[tip.realtime != 0 ? RealTime : NotRealTime]),
                    phrases.text<ServoLateness>(fmt::format("{:.0f}", late_us), std::to_string(timing.missed),
                                                std::to_string(timing.ticks + timing.missed))});
  }
  if (tip.safety.motor_heat > kWarmEnoughToShow) {
    rows.push_back({phrases[Motors], phrases.text<MotorsWarm>(fmt::format("{:.0f}", 100.0 * tip.safety.motor_heat)),
                    phrases.text<MotorsForce>(fmt::format("{:.0f}", 100.0 * tip.safety.thermal_gain))});
  }
  return rows;
}

}  // namespace afm::exhibit
