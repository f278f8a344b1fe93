// SPDX-License-Identifier: Apache-2.0
#include "app/micro/benchmark.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "core/log.h"
#include "core/written_by.h"

namespace afm::app {
namespace {

constexpr double kRepetitionLasts_s = 0.03;

// Google Benchmark 1.7 (Debian 12) reports that an error occurred, 1.9 (Debian 13) that the run was skipped.
template <class Run>
std::optional<std::string> failure_of(const Run& run) {
  if constexpr (requires { run.error_occurred; }) {
    return run.error_occurred ? std::optional(run.error_message) : std::nullopt;
  } else {
    return static_cast<int>(run.skipped) != 0 ? std::optional(run.skip_message) : std::nullopt;
  }
}

// Collects the times of one loop iteration instead of printing them.
class Collector : public benchmark::BenchmarkReporter {
 public:
  explicit Collector(BenchmarkClock clock) : clock_(clock) {}

  bool ReportContext(const Context&) override { return true; }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      const auto failure = failure_of(run);
      if (failure) error_ = *failure;
      if (failure || run.run_type != Run::RT_Iteration) continue;
      const double total = clock_ == BenchmarkClock::Wall ? run.real_accumulated_time : run.cpu_accumulated_time;
      seconds_.push_back(total / static_cast<double>(run.iterations));
    }
  }

  std::vector<double>& seconds() { return seconds_; }
  const std::string& error() const { return error_; }

 private:
  BenchmarkClock clock_;
  std::vector<double> seconds_;
  std::string error_;
};

std::string duration(double seconds) {
  constexpr std::array kUnits{std::pair{1.0, "s"}, std::pair{1e-3, "ms"}, std::pair{1e-6, "us"}, std::pair{1e-9, "ns"}};
  const auto* unit = std::find_if(kUnits.begin(), kUnits.end() - 1, [&](const auto& u) { return seconds >= u.first; });
  return fmt::format("{:.3g} {}", seconds / unit->first, unit->second);
}

const char* name_of(BenchmarkClock clock) { return clock == BenchmarkClock::Wall ? "wall" : "processor"; }

core::Result<BenchmarkFigure> run_benchmark(const BenchmarkCase& each) {
  benchmark::RegisterBenchmark(each.name.c_str(), each.run)
      ->Repetitions(kBenchmarkRepetitions)
      ->MinTime(kRepetitionLasts_s);
  Collector collector(each.clock);
  benchmark::RunSpecifiedBenchmarks(&collector, "all");
  benchmark::ClearRegisteredBenchmarks();
  std::vector<double>& seconds = collector.seconds();
  if (!collector.error().empty() || seconds.empty()) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot measure {}: {}", each.name, collector.error()));
  }
  std::sort(seconds.begin(), seconds.end());
  for (double& turn : seconds) turn /= each.operations;
  return BenchmarkFigure{each.name,       each.bar_s,    each.clock, seconds[seconds.size() / 2],
                         seconds.front(), seconds.back()};
}

}  // namespace

core::Result<std::vector<BenchmarkFigure>> run_benchmarks(const std::vector<BenchmarkCase>& cases) {
  std::vector<BenchmarkFigure> figures;
  for (const BenchmarkCase& each : cases) {
    core::log_line(fmt::format("measuring {} ({} of {})", each.name, figures.size() + 1, cases.size()));
    const auto figure = run_benchmark(each);
    if (!figure) return tl::unexpected(figure.error());
    figures.push_back(*figure);
  }
  return figures;
}

std::string benchmark_table(const std::vector<BenchmarkFigure>& figures) {
  std::string table = fmt::format("{:<28}{:>10}{:>10}{:>10}{:>10}  {:<10}{}\n", "operation", "median", "min", "max",
                                  "bar", "clock", "met");
  for (const BenchmarkFigure& figure : figures) {
    table += fmt::format("{:<28}{:>10}{:>10}{:>10}{:>10}  {:<10}{}\n", figure.name, duration(figure.median_s),
                         duration(figure.min_s), duration(figure.max_s), duration(figure.bar_s), name_of(figure.clock),
                         figure.met() ? "yes" : "no");
  }
  return table;
}

std::string benchmark_json(const std::vector<BenchmarkFigure>& figures) {
  nlohmann::ordered_json root;
  core::name_software(root);
  root["repetitions"] = kBenchmarkRepetitions;
  root["benchmarks"] = nlohmann::ordered_json::array();
  for (const BenchmarkFigure& figure : figures) {
    root["benchmarks"].push_back({{"name", figure.name},
                                  {"clock", name_of(figure.clock)},
                                  {"median_s", figure.median_s},
                                  {"min_s", figure.min_s},
                                  {"max_s", figure.max_s},
                                  {"bar_s", figure.bar_s},
                                  {"met", figure.met()}});
  }
  return root.dump(2) + "\n";
}

}  // namespace afm::app
