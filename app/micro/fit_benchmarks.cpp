// SPDX-License-Identifier: Apache-2.0
#include "app/micro/fit_benchmarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "core/freed_memory.h"
#include "curves/fitting/curve_fit.h"
#include "curves/fitting/fitted_curve.h"
#include "curves/synthetic_curve.h"
#include "fits/elastic_fit.h"

namespace afm::app {
namespace {

constexpr std::size_t kLongBranch = 2000, kShortBranch = 500, kCurves = 20;
constexpr double kRadiusM = 5e-6, kSpringNPerM = 0.05;
// nanite 4.2.0 took 12 ms for one curve of 4000 points; 10,000 curves in a minute on two threads
constexpr double kOneBar_s = 12e-3 / 20.0, kManyBar_s = 12e-3;
constexpr double kMostForInterval = 4.0, kLeastOfTwoThreads = 1.8;

constexpr std::string_view kAnalysed = "analyse and fit", kWith = "fit", kWithout = "fit without interval",
                           kOneThread = "a curve, one thread", kTwoThreads = "a curve, two threads";

// A gel of 3 kPa under a sphere of 5 um, with 15 pN of noise.
std::vector<curves::RecordedCurve> gels(std::size_t points_a_branch, std::size_t count) {
  curves::SyntheticSetup setup;
  setup.points = points_a_branch;
  setup.modulus_pa = 3e3;
  setup.radius_m = kRadiusM;
  setup.spring_n_per_m = kSpringNPerM;
  setup.most_force_n = 1e-9;
  setup.noise_n = 15e-12;
  auto made = curves::synthetic_curves(setup, count);
  return made ? std::move(made->curves) : std::vector<curves::RecordedCurve>();
}

curves::FitOptions paraboloid() {
  curves::FitOptions options;
  options.shape = fits::Shape::Paraboloid;
  options.radius_m = kRadiusM;
  return options;
}

bool is_fitted(const curves::RecordedCurve& curve) {
  return curves::fitted_curve("gel", curve, paraboloid()).fit.has_value();
}

void analysed(benchmark::State& state) {
  const auto curve = gels(kLongBranch, 1);
  for (auto turn : state) {
    if (curve.empty() || !is_fitted(curve.front())) {
      state.SkipWithError("the curve was not fitted");
      return;
    }
  }
}

// Fits only the approach, in the form in which an analysis passes it on.
void fit(benchmark::State& state, bool interval) {
  const auto curve = gels(kLongBranch, 1);
  std::vector<fits::Sample> samples;
  for (std::size_t i = 0; !curve.empty() && i < kLongBranch; ++i) {
    samples.push_back({curve.front().points[i].z.si, curve.front().points[i].force.si});
  }
  fits::FitSetup setup;
  setup.indenter = {.shape = fits::Shape::Paraboloid, .radius_m = kRadiusM, .table = {}};
  setup.spring_n_per_m = kSpringNPerM;
  setup.interval = interval;
  setup.starts = {10e-9};
  std::string why;
  for (auto turn : state) {
    if (!fits::fit(samples, setup, why)) {
      state.SkipWithError(why.c_str());
      return;
    }
  }
}

void many(benchmark::State& state, std::size_t threads) {
  const auto curves = gels(kShortBranch, kCurves);
  for (auto turn : state) {
    std::vector<std::size_t> fitted(threads);
    {
      std::vector<std::jthread> workers;
      workers.reserve(threads);
      for (std::size_t first = 0; first < threads; ++first) {
        workers.emplace_back([&, first] {
          for (std::size_t i = first; i < curves.size(); i += threads) fitted[first] += is_fitted(curves[i]) ? 1U : 0U;
        });
      }
    }
    std::size_t all = 0;
    for (const std::size_t of_one : fitted) all += of_one;
    if (all != kCurves) {
      state.SkipWithError("a curve was not fitted");
      return;
    }
  }
}

}  // namespace

std::vector<BenchmarkCase> fit_benchmarks() {
  core::keep_freed_memory();  // as in the command
  const auto name = [](std::string_view text) { return std::string(text); };
  constexpr auto kMany = static_cast<double>(kCurves);
  return {{.name = name(kAnalysed), .bar_s = kOneBar_s, .run = analysed},
          {.name = name(kWith), .bar_s = kOneBar_s, .run = [](benchmark::State& state) { fit(state, true); }},
          {.name = name(kWithout), .bar_s = kOneBar_s, .run = [](benchmark::State& state) { fit(state, false); }},
          {.name = name(kOneThread),
           .bar_s = kManyBar_s,
           .clock = BenchmarkClock::Wall,
           .operations = kMany,
           .run = [](benchmark::State& state) { many(state, 1); }},
          {.name = name(kTwoThreads),
           .bar_s = 0.5 * kManyBar_s,
           .clock = BenchmarkClock::Wall,
           .operations = kMany,
           .run = [](benchmark::State& state) { many(state, 2); }}};
}

std::string fit_ratios(const std::vector<BenchmarkFigure>& figures) {
  const auto median_s = [&](std::string_view name) -> std::optional<double> {
    const auto found =
        std::find_if(figures.begin(), figures.end(), [&](const auto& each) { return each.name == name; });
    return found != figures.end() ? std::optional(found->median_s) : std::nullopt;
  };
  const auto with = median_s(kWith), without = median_s(kWithout), one = median_s(kOneThread),
             two = median_s(kTwoThreads);
  if (!with || !without || !one || !two) return "";
  return fmt::format(
      "a fit with its interval takes {:.2f} times as long as without: at most {:g}\n"
      "two threads fit {:.2f} times as many curves as one: at least {:g}\n"
      "10,000 curves on two threads: {:.1f} s, at most 60 s\n",
      *with / *without, kMostForInterval, *one / *two, kLeastOfTwoThreads, 1e4 * *two);
}

}  // namespace afm::app
