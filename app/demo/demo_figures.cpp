// SPDX-License-Identifier: Apache-2.0
#include "app/demo/demo_figures.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "app/demo/demonstration.h"
#include "core/check.h"
#include "exhibit/frame/film_strip.h"
#include "exhibit/frame/frame_builder.h"
#include "exhibit/report/measurement.h"
#include "exhibit/report/report.h"
#include "exhibit/scenery/journey.h"
#include "exhibit/words/phrases.h"
#include "render/renderer.h"
#include "servo/session_file.h"

namespace afm::app {

namespace {

constexpr std::int64_t kAfterJumpInNs = 5'000'000;  // in tapping also before the jump off
constexpr std::uint32_t kFilmColumns = 5, kFilmReduction = 4;
constexpr std::int64_t kAfterJumpOffNs = 400'000'000;

exhibit::CycleResult result_of(const exhibit::Measurement& m) {
  const exhibit::CycleEvents& events = m.measured;
  return {m.title,       m.law,          m.hysteretic,   events.f_attr_n,
          events.f_ad_n, events.z_jtc_m, events.z_joc_m, m.tapped.has_value()};
}

// Times of the first and the last sample in contact.
std::pair<std::int64_t, std::int64_t> contact_of(const servo::RecordedSession& session) {
  const auto attached = [](const scene::TipSample& sample) { return sample.phase == physics::Phase::Attached; };
  const auto first = std::find_if(session.samples.begin(), session.samples.end(), attached);
  const auto last = std::find_if(session.samples.rbegin(), session.samples.rend(), attached);
  AFM_CHECK(first != session.samples.end());
  return {first->time_ns, last->time_ns};
}

}  // namespace

FigurePlan::FigurePlan(const std::vector<servo::RecordedSession>& sessions,
                       const std::vector<exhibit::Measurement>& measurements, std::size_t shown_material,
                       const exhibit::Phrases& phrases) {
  const servo::RecordedSession& shown = sessions.at(shown_material);
  const auto [in_ns, off_ns] = contact_of(shown);
  const auto deepest = std::min_element(shown.samples.begin(), shown.samples.end(),
                                        [](const auto& a, const auto& b) { return a.tip.z_m < b.tip.z_m; });

  using enum exhibit::Phrase;
  struct Plan {
    const char* file;
    exhibit::Phrase caption;
    std::optional<exhibit::Phrase> guidance;
    std::int64_t time_ns;
  };
  const bool taps = measurements.at(shown_material).tapped.has_value();
  const std::array<Plan, 4> plans =
      taps ? std::array<Plan, 4>{{{"fig5a.png", CaptionRepelled, {}, in_ns + kAfterJumpInNs},
                                  {"fig5b.png", CaptionTapped, {}, deepest->time_ns},
                                  {"fig5c.png", CaptionLastRepelled, {}, off_ns - kAfterJumpInNs},
                                  {"fig5d.png", CaptionSwingsFree, {}, off_ns + kAfterJumpOffNs}}}
           : std::array<Plan, 4>{{{"fig5a.png", CaptionSnapIn, SnappedIn, in_ns + kAfterJumpInNs},
                                  {"fig5b.png", CaptionPressed, BeamBends, deepest->time_ns},
                                  {"fig5c.png", CaptionAdhesion, AdhesionHolds, off_ns},
                                  {"fig5d.png", CaptionFree, Released, off_ns + kAfterJumpOffNs}}};

  // reserved, because the moments point into it
  curves_.reserve(plans.size() + 1);
  for (const Plan& plan : plans) {
    curves_.emplace_back(sessions.size());
    curves_.back()[shown_material] = exhibit::curve_until(shown, plan.time_ns);
    exhibit::Moment moment = exhibit::moment_of(shown, shown_material, plan.time_ns, curves_.back());
    if (plan.guidance) moment.guidance = phrases[*plan.guidance];
    figures_.push_back({plan.file, phrases[plan.caption], moment});
  }

  curves_.emplace_back();
  for (const servo::RecordedSession& session : sessions)
    curves_.back().push_back(exhibit::curve_until(session, session.samples.back().time_ns));
  exhibit::Moment finale = exhibit::moment_of(shown, shown_material, plans.back().time_ns, curves_.back());
  finale.wall.centerpiece = exhibit::Centerpiece::Plot;
  for (const exhibit::Measurement& m : measurements) {
    finale.results.push_back(result_of(m));
  }
  finale.guidance = phrases[AllSamples];
  figures_.push_back({"fig5e.png", phrases[taps ? CaptionAmplitudes : CaptionAll], finale});
}

VariationFigure::VariationFigure(const servo::RecordedSession& base, const exhibit::Measurement& measurement,
                                 const curves::SampleModel& model, std::span<const exhibit::Variation> variations,
                                 std::size_t material, const exhibit::Phrases& phrases) {
  std::vector<exhibit::CycleResult> all;
  const auto add = [&](const servo::RecordedSession& session, const exhibit::Measurement& m,
                       const curves::SampleModel& was_felt) {
    materials_.push_back(was_felt);
    curves_.push_back(exhibit::curve_until(session, session.samples.back().time_ns));
    all.push_back(result_of(m));
  };
  add(base, measurement, model);
  for (const exhibit::Variation& variation : variations) {
    if (variation.material == material) add(variation.session, variation.measurement, variation.model);
  }
  moment_ = exhibit::moment_of(base, material, base.samples.back().time_ns, curves_);
  moment_.results = std::move(all);
  moment_.wall.centerpiece = exhibit::Centerpiece::Plot;
  moment_.guidance = phrases[exhibit::Phrase::OtherParameters];
}

render::Image journey_strip(const exhibit::FrameBuilder& frames, render::Renderer& renderer) {
  std::vector<render::Image> stills;
  for (double orders = 0.0; orders <= exhibit::kJourneyOrders; orders += 1.0) {
    exhibit::Moment moment;
    moment.wall = {.material = 0, .centerpiece = exhibit::Centerpiece::Journey, .journey_orders = orders};
    moment.realtime = true;  // real time, since nothing moves
    renderer.render(frames.build(moment));
    stills.push_back(renderer.read_eye(scene::Eye::Left));
  }
  return exhibit::film_strip(stills, kFilmColumns, kFilmReduction);
}

}  // namespace afm::app
