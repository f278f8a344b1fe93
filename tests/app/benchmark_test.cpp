// SPDX-License-Identifier: Apache-2.0
#include "app/micro/benchmark.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "app/micro/fit_benchmarks.h"
#include "app/micro/physics_benchmarks.h"

namespace afm::app {
namespace benchmark_test {

using testing::HasSubstr;

BenchmarkCase counting(double operations) {
  return {.name = "counting", .bar_s = 1e-3, .operations = operations, .run = [](benchmark::State& state) {
            for (auto turn : state) {
              for (int i = 0; i < 1000; ++i) benchmark::DoNotOptimize(i);
            }
          }};
}

TEST(Benchmark, MeasuresTimesThatAreInOrder) {
  const auto figures = run_benchmarks({counting(1.0)});
  ASSERT_TRUE(figures) << figures.error().message;
  ASSERT_EQ(figures->size(), 1U);
  const BenchmarkFigure& figure = figures->front();
  EXPECT_GT(figure.min_s, 1e-8);
  EXPECT_LE(figure.min_s, figure.median_s);
  EXPECT_LE(figure.median_s, figure.max_s);
}

TEST(Benchmark, DividesATurnOfTheLoopByItsOperations) {
  const auto figures = run_benchmarks({counting(1.0), counting(1e6)});
  ASSERT_TRUE(figures);
  EXPECT_LT(figures->at(1).max_s, 1e-3 * figures->at(0).min_s);
}

TEST(Benchmark, FailsWithTheCaseThatFails) {
  const auto figures = run_benchmarks({{.name = "broken", .run = [](benchmark::State& state) {
                                          state.SkipWithError("it broke");
                                          for (auto turn : state) {
                                          }
                                        }}});
  ASSERT_FALSE(figures);
  EXPECT_EQ(figures.error().message, "cannot measure broken: it broke");
}

TEST(Benchmark, PrintsWhatMeetsItsBarAndWhatDoesNot) {
  const std::vector<BenchmarkFigure> figures{
      {.name = "quick", .bar_s = 50e-9, .median_s = 12.34e-9, .min_s = 12e-9, .max_s = 20e-9},
      {.name = "slow", .bar_s = 1e-2, .clock = BenchmarkClock::Wall, .median_s = 2e-2, .min_s = 1e-2, .max_s = 3.0}};
  const std::string table = benchmark_table(figures);
  EXPECT_THAT(table, HasSubstr("12.3 ns     12 ns     20 ns     50 ns  processor yes"));
  EXPECT_THAT(table, HasSubstr("20 ms     10 ms       3 s     10 ms  wall      no"));

  const auto json = nlohmann::json::parse(benchmark_json(figures));
  EXPECT_EQ(json["benchmarks"][0]["median_s"], 12.34e-9);
  EXPECT_EQ(json["benchmarks"][0]["met"], true);
  EXPECT_EQ(json["benchmarks"][1]["clock"], "wall");
  EXPECT_EQ(json["benchmarks"][1]["met"], false);
}

TEST(PhysicsBenchmarks, HaveNamesOfTheirOwnAndBars) {
  std::set<std::string> names;
  for (const BenchmarkCase& each : physics_benchmarks("touchafm")) {
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
    EXPECT_GT(each.bar_s, 0.0) << each.name;
  }
  EXPECT_EQ(names.size(), 16U);
}

TEST(FitBenchmarks, HaveNamesOfTheirOwnBarsAndRatios) {
  std::set<std::string> names;
  std::vector<BenchmarkFigure> figures;
  for (const BenchmarkCase& each : fit_benchmarks()) {
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
    EXPECT_GT(each.bar_s, 0.0) << each.name;
    const double median_s = each.name == "fit without interval"   ? 1e-3
                            : each.name == "a curve, two threads" ? 2e-3
                                                                  : 3e-3;
    figures.push_back({.name = each.name, .bar_s = each.bar_s, .median_s = median_s, .min_s = 0.0, .max_s = 0.0});
  }
  const std::string ratios = fit_ratios(figures);
  EXPECT_THAT(ratios, HasSubstr("a fit with its interval takes 3.00 times as long as without: at most 4\n"));
  EXPECT_THAT(ratios, HasSubstr("two threads fit 1.50 times as many curves as one: at least 1.8\n"));
  EXPECT_THAT(ratios, HasSubstr("10,000 curves on two threads: 20.0 s, at most 60 s\n"));
  figures.pop_back();
  EXPECT_EQ(fit_ratios(figures), "");
}

// Each benchmark fits the curves that it measures.
TEST(FitBenchmarks, FitTheirCurves) {
  const auto figures = run_benchmarks({fit_benchmarks().at(1)});
  ASSERT_TRUE(figures) << figures.error().message;
  EXPECT_GT(figures->front().median_s, 0.0);
}

}  // namespace benchmark_test
}  // namespace afm::app
