// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <memory>

#include "app/bench/haptics_benchmarks.h"
#include "app/bench/physics_benchmarks.h"
#include "app/bench/render_benchmarks.h"
#include "app/command.h"

namespace afm::app {
namespace {

// What a subject of benchmarks has to measure; it is asked only when it was chosen.
using ListCases = std::vector<BenchmarkCase> (*)(const std::string& program);

void add_subject(OptionList& bench, const CommandContext& context, const char* name, const char* description,
                 ListCases cases) {
  OptionList command = bench.add_command(name, description);
  // shared: the parser writes into it while it lives, the chosen command reads it afterwards
  const auto as_json = std::make_shared<bool>(false);
  command.add_flag("--json", *as_json, "print JSON, in seconds, instead of a table");
  command.footer(std::string("example: touchafm bench ") + name + " --json");
  command.when_chosen([as_json, cases, &context]() -> core::Result<void> {
    const auto figures = run_benchmarks(cases(context.program_path));
    if (!figures) return tl::unexpected(figures.error());
    const std::string text = *as_json ? benchmark_json(*figures) : benchmark_table(*figures);
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (!written || std::fflush(stdout) != 0) {
      return core::failure(core::ErrorCategory::Failed, "cannot write to stdout");
    }
    return {};
  });
}

}  // namespace

void add_bench_command(OptionList& program, const CommandContext& context) {
  OptionList bench = program.add_command("bench", "measure this machine against the bars of the design");
  bench.footer("A bar that is not met changes no exit code.\nexample: touchafm bench physics");
  add_subject(bench, context, "physics", "a tick and the tables of each law, the dynamics, a whole curve",
              physics_benchmarks);
  add_haptics_benchmarks(bench, context);
  add_render_benchmarks(bench, context);
}

}  // namespace afm::app
