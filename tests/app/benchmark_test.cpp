// SPDX-License-Identifier: Apache-2.0
#include "app/micro/benchmark.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

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

}  // namespace benchmark_test
}  // namespace afm::app
