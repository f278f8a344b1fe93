// SPDX-License-Identifier: Apache-2.0
// Started by `touchafm bench physics` and `bench fits`. A separate program, so that touchafm itself needs no benchmark
// library.
#include <cstdio>
#include <string>

#include "app/micro/fit_benchmarks.h"
#include "app/micro/physics_benchmarks.h"
#include "app/options/command_line.h"
#include "core/exit_code.h"
#include "core/own_folder.h"
#include "core/run_main.h"
#include "core/version.h"

namespace {

using afm::core::ExitCode;
using afm::core::fail;

int run(int count, char** arguments) {
  afm::app::CommandLine command_line(
      "touchafm-bench", afm::core::kVersion,
      "measure a tick and the tables of each law, the lever's dynamics, and a whole curve");
  bool as_json = false, of_fits = false;
  command_line.add_flag("--json", as_json, "print JSON with times in seconds instead of a table");
  command_line.add_flag("--fits", of_fits, "measure fits instead");
  const auto answer = command_line.parse(count, arguments);
  if (!answer) return fail(ExitCode::WrongUsage, answer.error().message);
  std::string text = *answer;
  if (text.empty()) {
    const std::string touchafm = afm::core::own_program().replace_filename("touchafm").string();
    const auto figures =
        afm::app::run_benchmarks(of_fits ? afm::app::fit_benchmarks() : afm::app::physics_benchmarks(touchafm));
    if (!figures) return fail(afm::core::exit_code(figures.error().category), figures.error().message);
    text = as_json ? benchmark_json(*figures) : benchmark_table(*figures) + afm::app::fit_ratios(*figures);
  }
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written || std::fflush(stdout) != 0) return fail(ExitCode::RunFailed, "cannot write to stdout");
  return static_cast<int>(ExitCode::Done);
}

}  // namespace

int main(int count, char** arguments) {
  return afm::core::run_main([&] { return run(count, arguments); });
}
