// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <memory>
#include <string>

#include "app/bench/cluster_benchmarks.h"
#include "app/bench/haptics_benchmarks.h"
#include "app/bench/render_benchmarks.h"
#include "app/bench/tapping_benchmarks.h"
#include "app/options/command.h"
#include "core/system_error.h"

namespace afm::app {
namespace {

// Replaces this process by the benchmark program. Returns only on failure, with the reason.
core::Result<void> become_benchmarks(const std::string& program, bool as_json) {
  std::string path = std::filesystem::path(program).replace_filename("touchafm-bench").string();
  std::string json = "--json";
  const std::array arguments{path.data(), as_json ? json.data() : nullptr, static_cast<char*>(nullptr)};
  ::execv(path.c_str(), arguments.data());
  return core::failure(
      core::ErrorCategory::Failed,
      fmt::format("cannot start {}: {}; install touchafm completely, or build the target touchafm-bench", path,
                  core::system_error(errno)));
}

}  // namespace

void add_bench_command(OptionList& program, const CommandContext& context) {
  OptionList bench =
      program.add_command("bench", "measure the performance of physics, servo, renderer and cluster on this machine");
  bench.footer(
      "A missed target does not change the exit code.\n"
      "example: touchafm bench physics");
  OptionList physics = bench.add_command(
      "physics", "measure a tick and the tables of each law, the lever's dynamics, and a whole curve");
  // shared: the parser writes into it while it lives, the chosen command reads it afterwards
  const auto as_json = std::make_shared<bool>(false);
  physics.add_flag("--json", *as_json, "print JSON with times in seconds instead of a table");
  physics.footer("example: touchafm bench physics --json");
  physics.when_chosen([as_json, &context] { return become_benchmarks(context.program_path, *as_json); });
  add_tapping_benchmarks(bench, context);
  add_haptics_benchmarks(bench, context);
  add_render_benchmarks(bench, context);
  add_cluster_benchmarks(bench, context);
}

}  // namespace afm::app
