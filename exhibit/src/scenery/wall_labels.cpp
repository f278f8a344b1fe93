// SPDX-License-Identifier: Apache-2.0
#include "scenery/wall_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <string>

#include "exhibit/scenery/wall_layout.h"
#include "exhibit/scenery/wall_marks.h"
#include "physics/quantity_text.h"

namespace afm::exhibit {

using glm::dmat4;
using glm::dvec3;

render::Label cue_label(const JumpCue& cue, const Phrases& phrases, const WallPlaces& places, const dvec3& touched_m) {
  const auto vector = [&](double x, double y) { return dvec3(places.room_from_layout() * glm::dvec4(x, y, 0.0, 0.0)); };
  return {.text = cue_text(cue, phrases),
          .highlighted = false,
          .placement = {.lower_left_m = touched_m + vector(places.cue_left(), kCuePlace.y),
                        .right_m = vector(kCuePlace.x + kCueWidth - places.cue_left(), 0.0),
                        .up_m = vector(0.0, kCueHeight)}};
}

void add_journey_labels(const Journey& journey, const WallPlaces& places, const Phrases& phrases, double orders,
                        render::FrameState& frame) {
  if (orders >= kGapFromOrders) {
    const double middle = 0.5 * journey.gap_m() * std::pow(10.0, orders);
    frame.labels.push_back(
        {.text = phrases.text<Phrase::JourneyGap>(fmt::format("{:.1f} nm", journey.gap_m() * 1e9)),
         .highlighted = false,
         .placement = places.in_scene(kGapLabelRight - kGapLabelWidth, middle - 0.5 * kGapLabelHeight, kGapLabelWidth,
                                      kGapLabelHeight)});
  }
  if (orders >= kApexFromOrders && orders < kApexToOrders) {
    frame.labels.push_back({.text = phrases[Phrase::PlaceApex],
                            .highlighted = false,
                            .placement = places.in_wall(-0.5 * kApexLabelWidth, kApexLabelBottom, kApexLabelWidth,
                                                        kCompanionLabelHeight)});
  }
  const auto here = static_cast<std::size_t>(std::lround(orders));
  constexpr auto kRungs = static_cast<std::size_t>(kJourneyOrders) + 1;
  for (std::size_t i = 0; i < kRungs; ++i) {
    const std::string length = scale_bar(std::pow(10.0, -static_cast<double>(i)), 1.0 + 1e-9).text;
    frame.labels.push_back({.text = length, .highlighted = i == here, .placement = places.rung(kRungs - 1 - i)});
  }
}

void add_companion_label(const Journey::Companion& companion, const dmat4& room_from_journey, const WallPlaces& places,
                         const Phrases& phrases, render::FrameState& frame) {
  const double unit_m = places.unit_m();
  const auto axis = [&](const glm::dvec4& column) { return unit_m * glm::normalize(dvec3(column)); };
  constexpr double kBesideRuler = kRulerFoot.x + 3.0 * kRulerTextGap + 0.5 * kCompanionLabelWidth;
  const double across = companion.place.x > 0.0 ? std::max(companion.place.x, kBesideRuler) : companion.place.x;
  const dvec3 middle = dvec3(room_from_journey[3]) + across * axis(room_from_journey[0]) +
                       companion.place.y * axis(room_from_journey[1]) + companion.place.z * axis(room_from_journey[2]);
  const dvec3 right(places.room_from_layout() * glm::dvec4(kCompanionLabelWidth, 0.0, 0.0, 0.0));
  const dvec3 up(places.room_from_layout() * glm::dvec4(0.0, kCompanionLabelHeight, 0.0, 0.0));
  frame.labels.push_back({.text = phrases[companion.name],
                          .highlighted = false,
                          .placement = {.lower_left_m = middle - 0.5 * right, .right_m = right, .up_m = up}});
}

void add_height_labels(const WallPlaces& places, const Phrases& phrases, double range_m,
                       std::optional<double> exaggeration, render::FrameState& frame) {
  const auto length = [](double length_m) {
    std::string text = physics::format_quantity(physics::Length(length_m), physics::kLengthUnits, 3);
    if (const auto micro = text.find("um"); micro != std::string::npos) text.replace(micro, 1, "\u00b5");
    return text;
  };
  frame.labels.push_back({length(range_m), false, places.height_bar_text(1.0)});
  if (exaggeration) {
    frame.labels.push_back(
        {phrases.text<Phrase::HeightsTimes>(fmt::format("{:g}", *exaggeration)), false, places.height_bar_text(0.5)});
  }
  frame.labels.push_back({"0", false, places.height_bar_text(0.0)});
}

}  // namespace afm::exhibit
