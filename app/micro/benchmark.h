// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <string>
#include <vector>

#include "core/result.h"

namespace afm::app {

// Processor time excludes other programs; wall time is the time for which a person waits.
enum class BenchmarkClock { Processor, Wall };

// One operation to measure. `run` is a Google Benchmark: it sets up, then loops over the state; only the loop is timed.
struct BenchmarkCase {
  std::string name;
  double bar_s = 0.0;  // longest accepted time of one operation
  BenchmarkClock clock = BenchmarkClock::Processor;
  double operations = 1.0;  // number per loop iteration
  std::function<void(benchmark::State&)> run;
};

// Time of one operation: median, minimum and maximum over repetitions. Each repetition is the mean of as many
// iterations as fill a few hundredths of a second.
struct BenchmarkFigure {
  std::string name;
  double bar_s = 0.0;
  BenchmarkClock clock = BenchmarkClock::Processor;
  double median_s = 0.0;
  double min_s = 0.0;
  double max_s = 0.0;

  bool met() const { return median_s <= bar_s; }
};

inline constexpr int kBenchmarkRepetitions = 15;

// Runs the cases in turn, with a line of progress each. Fails if one of them fails or the run is interrupted.
core::Result<std::vector<BenchmarkFigure>> run_benchmarks(const std::vector<BenchmarkCase>& cases);

// Results as a table and as JSON; durations in JSON are seconds.
std::string benchmark_table(const std::vector<BenchmarkFigure>& figures);
std::string benchmark_json(const std::vector<BenchmarkFigure>& figures);

}  // namespace afm::app
