// SPDX-License-Identifier: Apache-2.0
#include "app/bench/tapping_benchmarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "app/bench/runge_kutta_tip.h"
#include "core/log.h"
#include "core/percentiles.h"
#include "core/written_by.h"
#include "imaging/scan_run.h"
#include "physics/force_model.h"
#include "physics/tapping/tap_surface.h"
#include "physics/tapping/tapping_curve.h"
#include "physics/tapping/tapping_model.h"
#include "physics/tapping/tapping_oscillator.h"

namespace afm::app {
namespace {

using namespace physics::literals;
using physics::Length;

constexpr double kQuality = 400.0, kResonanceHz = 300e3;

struct TappingBenchOptions {
  int rounds = 5;
  bool json = false;
};

// A measured time compared with another one, or with a limit.
struct TappingFigure {
  std::string name;
  double seconds = 0;
  std::string against;  // name of the other time; empty: the limit is a time
  double against_s = 1.0;
  double limit = 0;

  double ratio() const { return seconds / against_s; }
  bool met() const { return ratio() <= limit; }
};

// The sample of docs/tapping.md.
physics::ContactParameters polymer() {
  physics::ContactParameters contact;
  contact.tip_radius = 20_nm;
  contact.spring_constant = 40_N_per_m;
  contact.sample_stiffness = physics::Stiffness(std::numeric_limits<double>::infinity());
  contact.hamaker = 64_zJ;
  // the attraction at 0.165 nm is the pull-off force
  contact.mean_surface_energy = physics::SurfaceEnergy(64e-21 / (24.0 * std::numbers::pi * 0.165e-9 * 0.165e-9));
  contact.reduced_modulus = physics::Pressure(1.5e9);
  return contact;
}

struct Tapped {
  std::shared_ptr<const physics::TapSurface> surface =
      std::make_shared<const physics::TapSurface>(physics::Law::Dmt, polymer());
  physics::DrivenLever lever =
      physics::driven_lever(40_N_per_m, {physics::Frequency(kResonanceHz), kQuality, physics::Temperature()},
                            {20_nm, physics::Frequency(kResonanceHz)});
};

double clock_s(clockid_t clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Processor time of this thread.
double time_of(const std::function<void()>& work) {
  const double before_s = clock_s(CLOCK_THREAD_CPUTIME_ID);
  work();
  return clock_s(CLOCK_THREAD_CPUTIME_ID) - before_s;
}

// Medians of both, measured in turn, so that a machine that slows down slows both.
std::pair<double, double> medians(int rounds, const std::function<double()>& one,
                                  const std::function<double()>& other) {
  std::vector<double> ones, others;
  for (int i = 0; i < rounds; ++i) {
    ones.push_back(one());
    others.push_back(other());
  }
  return {core::percentiles(std::move(ones)).p50, core::percentiles(std::move(others)).p50};
}

// 99th percentile of a tick over cycles of the hand from above both states to 12 nm.
template <class Model>
double tick_p99_s(Model& model) {
  constexpr int kTicks = 20'000;
  std::vector<double> ticks_s(kTicks);
  for (int i = 0; i < kTicks; ++i) {
    const Length z(1e-9 * (18.0 + 6.0 * std::cos(0.002 * i)));
    const double before_s = clock_s(CLOCK_MONOTONIC);
    (void)model.step(z);
    ticks_s[static_cast<std::size_t>(i)] = clock_s(CLOCK_MONOTONIC) - before_s;
  }
  return core::percentiles(std::move(ticks_s)).p99;
}

std::vector<TappingFigure> tick_figures(const Tapped& tapped, int rounds) {
  const auto tables = physics::tapped_law_tables(physics::Law::Dmt, tapped.surface, tapped.lever);
  physics::TappingModel envelope(tapped.surface, tapped.lever, tables, physics::Time(1e-3));
  physics::ApproachRetractModel still(physics::build_law_tables(physics::Law::Dmt, polymer()));
  const auto [tick_s, static_s] =
      medians(rounds, [&] { return tick_p99_s(envelope); }, [&] { return tick_p99_s(still); });
  return {{"p99 of an envelope's tick", tick_s, "", 1.0, 5e-6},
          {"p99 of an envelope's tick", tick_s, "p99 of a tick without mass", static_s, 10.0}};
}

// Time of a curve with 400 heights, down and up.
TappingFigure curve_figure(const Tapped& tapped, int rounds) {
  const physics::TapPath path{{22_nm, 2.05_nm, 0.1_nm}, {}};
  const auto timed = [&](physics::TapMethod method) {
    return time_of([&] { (void)physics::record_tapping_curve(tapped.surface, tapped.lever, path, method); });
  };
  const auto [averaged_s, direct_s] = medians(
      rounds, [&] { return timed(physics::TapMethod::Averaged); }, [&] { return timed(physics::TapMethod::Direct); });
  return {"a curve of 400 heights, averaged", averaged_s, "the same by direct integration", direct_s, 0.02};
}

RungeKuttaTip runge_kutta(Length z, const physics::TapState& from) {
  const double phase = from.phase, amplitude = from.amplitude.si;
  return {.spring_constant = 40.0,
          .quality_factor = kQuality,
          .free_amplitude = 20e-9,
          .tip_radius = 20e-9,
          .hamaker = 64e-21,
          .reduced_modulus = 1.5e9,
          .contact_gap = 0.165e-9,
          .z = z.si,
          .x = amplitude * std::cos(phase),
          .v = amplitude * std::sin(phase)};
}

// Time of a step, at equal error in A, in the attractive and in the repulsive state.
TappingFigure step_figure(const Tapped& tapped, int rounds) {
  constexpr int kReference = 6400, kSettle = 1600, kTimed = 400;
  constexpr std::array kSteps{100, 140, 200, 280, 400, 560, 800, 1130, 1600, 2260, 3200};
  const std::array heights{18.5_nm, 12_nm};
  double error_m = 0.0;
  std::array<double, kSteps.size()> errors_m{};
  physics::TappingOscillator tip(tapped.surface, tapped.lever);
  for (const Length z : heights) {
    tip.place(z, {tapped.lever.free_amplitude, tapped.lever.free_phase});
    const physics::TapState direct = tip.settle().state;
    const double exact_m = runge_kutta(z, direct).swing(kSettle, kReference);
    error_m = std::max(error_m, std::abs(direct.amplitude.si - exact_m));
    for (std::size_t i = 0; i < kSteps.size(); ++i) {
      const double amplitude_m = runge_kutta(z, direct).swing(kSettle, kSteps[i]);
      errors_m[i] = std::max(errors_m[i], std::abs(amplitude_m - exact_m));
    }
  }
  // the fewest steps from which on none has a larger error
  std::size_t fewest = kSteps.size() - 1;
  while (fewest > 0 && errors_m[fewest - 1] <= error_m) --fewest;
  const int steps = kSteps[fewest];
  const Length z = heights[1];
  const physics::TapState at_rest = tip.settle().state;
  const auto [direct_s, anchor_s] = medians(
      rounds,
      [&] {
        return time_of([&] {
          for (int i = 0; i < kTimed; ++i) (void)tip.swing();
        });
      },
      [&] { return time_of([&] { (void)runge_kutta(z, at_rest).swing(kTimed, steps); }); });
  return {"a swing by direct integration", direct_s / kTimed,
          fmt::format("RK4 of {} steps, as exact in A ({:.1e})", steps, error_m / 20e-9), anchor_s / kTimed, 0.5};
}

core::Result<TappingFigure> image_figure(const CommandContext& context, int rounds) {
  imaging::ScanRequest request;
  request.contact.assets_dir = context.assets_dir;
  request.contact.material = "mica";
  request.contact.values = {{"spring-constant", "40N/m"}, {"resonance", "300kHz"}, {"quality-factor", "400"}};
  request.tapping.mode = "tapping";
  request.tapping.numbers.free_amplitude = "20nm";
  request.amplitude_setpoint = "0.8";
  std::vector<double> taken_s;
  for (int i = 0; i < rounds; ++i) {
    // processor time of all threads
    const double before_s = clock_s(CLOCK_PROCESS_CPUTIME_ID);
    if (const auto scan = imaging::take_scan(request); !scan) return tl::unexpected(scan.error());
    taken_s.push_back(clock_s(CLOCK_PROCESS_CPUTIME_ID) - before_s);
  }
  return TappingFigure{"an image of 256 x 256, processor time", core::percentiles(std::move(taken_s)).p50, "", 1.0,
                       2.0};
}

core::Result<std::vector<TappingFigure>> measure(const CommandContext& context, const TappingBenchOptions& options) {
  const Tapped tapped;
  core::log_line("measuring the tick of an envelope");
  std::vector<TappingFigure> figures = tick_figures(tapped, options.rounds);
  core::log_line("measuring a curve beside direct integration");
  figures.push_back(curve_figure(tapped, options.rounds));
  core::log_line("measuring direct integration beside Runge-Kutta");
  figures.push_back(step_figure(tapped, options.rounds));
  core::log_line("measuring an image");
  auto image = image_figure(context, options.rounds);
  if (!image) return tl::unexpected(image.error());
  figures.push_back(std::move(*image));
  return figures;
}

std::string time_text(double seconds) {
  return seconds < 1e-3 ? fmt::format("{:.3g} us", 1e6 * seconds) : fmt::format("{:.3g} s", seconds);
}

std::string tapping_table(const std::vector<TappingFigure>& figures) {
  std::string text =
      fmt::format("{:<39}{:>10}  {:<45}{:>10}{:>9}{:>8}  met\n", "", "", "against", "", "ratio", "limit");
  for (const TappingFigure& each : figures) {
    const bool timed = each.against.empty();
    text += fmt::format("{:<39}{:>10}  {:<45}{:>10}{:>9}{:>8}  {}\n", each.name, time_text(each.seconds),
                        timed ? "a time" : each.against, timed ? time_text(each.limit) : time_text(each.against_s),
                        fmt::format("{:.3g}", timed ? each.seconds / each.limit : each.ratio()),
                        timed ? "1" : fmt::format("{:g}", each.limit), each.met() ? "yes" : "no");
  }
  return text;
}

std::string tapping_json(const std::vector<TappingFigure>& figures, int rounds) {
  nlohmann::ordered_json root;
  core::name_software(root);
  root["rounds"] = rounds;
  root["figures"] = nlohmann::ordered_json::array();
  for (const TappingFigure& each : figures) {
    nlohmann::ordered_json figure{{"name", each.name}, {"seconds", each.seconds}};
    if (each.against.empty()) {
      figure["limit_s"] = each.limit;
    } else {
      figure["against"] = each.against;
      figure["against_s"] = each.against_s;
      figure["ratio"] = each.ratio();
      figure["limit"] = each.limit;
    }
    figure["met"] = each.met();
    root["figures"].push_back(std::move(figure));
  }
  return root.dump(2) + "\n";
}

}  // namespace

void add_tapping_benchmarks(OptionList& bench, const CommandContext& context) {
  OptionList command = bench.add_command(
      "tapping", "measure a tick, a curve, an image and direct integration of a lever that taps, as ratios");
  const auto options = std::make_shared<TappingBenchOptions>();
  command.add_option("--rounds", options->rounds, "rounds, whose medians are printed").within(1, 100).show_default();
  command.add_flag("--json", options->json, "print JSON with times in seconds instead of a table");
  command.footer("example: touchafm bench tapping");
  command.when_chosen([options, &context]() -> core::Result<void> {
    const auto figures = measure(context, *options);
    if (!figures) return tl::unexpected(figures.error());
    std::fputs((options->json ? tapping_json(*figures, options->rounds) : tapping_table(*figures)).c_str(), stdout);
    return {};
  });
}

}  // namespace afm::app
