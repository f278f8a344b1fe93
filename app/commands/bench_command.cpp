// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/analyse/map_benchmark.h"
#include "app/bench/cluster_benchmarks.h"
#include "app/bench/haptics_benchmarks.h"
#include "app/bench/render_benchmarks.h"
#include "app/bench/tapping_benchmarks.h"
#include "app/options/command.h"
#include "core/system_error.h"

namespace afm::app {
namespace {

// Replaces this process by the benchmark program. Returns only on failure, with the reason.
core::Result<void> become_benchmarks(const std::string& program, std::vector<std::string> flags) {
  std::string path = std::filesystem::path(program).replace_filename("touchafm-bench").string();
  std::vector<char*> arguments{path.data()};
  for (std::string& flag : flags) arguments.push_back(flag.data());
  arguments.push_back(nullptr);
  ::execv(path.c_str(), arguments.data());
  return core::failure(
      core::ErrorCategory::Failed,
      fmt::format("cannot start {}: {}; install touchafm completely, or build the target touchafm-bench", path,
                  core::system_error(errno)));
}

// Adds a command whose measurements are those of the benchmark program, with its flag.
void add_micro_benchmarks(OptionList& bench, const CommandContext& context, const std::string& name,
                          const std::string& help, const std::string& flag) {
  OptionList command = bench.add_command(name, help);
  // shared: the parser writes into it while it lives, the chosen command reads it afterwards
  const auto as_json = std::make_shared<bool>(false);
  command.add_flag("--json", *as_json, "print JSON with times in seconds instead of a table");
  command.footer(fmt::format("example: touchafm bench {} --json", name));
  command.when_chosen([as_json, flag, &context] {
    std::vector<std::string> flags;
    if (!flag.empty()) flags.push_back(flag);
    if (*as_json) flags.emplace_back("--json");
    return become_benchmarks(context.program_path, std::move(flags));
  });
}

}  // namespace

void add_bench_command(OptionList& program, const CommandContext& context) {
  OptionList bench = program.add_command(
      "bench", "measure the performance of physics, fits, maps, servo, renderer and cluster on this machine");
  bench.footer(
      "A missed target does not change the exit code.\n"
      "example: touchafm bench physics");
  add_micro_benchmarks(bench, context, "physics",
                       "measure a tick and the tables of each law, the lever's dynamics, and a whole curve", "");
  add_micro_benchmarks(bench, context, "fits",
                       "measure the fit of a curve, with and without its interval, and of many on two threads",
                       "--fits");
  add_map_benchmark(bench);
  add_tapping_benchmarks(bench, context);
  add_haptics_benchmarks(bench, context);
  add_render_benchmarks(bench, context);
  add_cluster_benchmarks(bench, context);
}

}  // namespace afm::app
