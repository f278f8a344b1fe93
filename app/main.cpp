// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "app/command.h"
#include "core/exit_code.h"
#include "core/run_main.h"
#include "core/version.h"

namespace {

using afm::core::ExitCode;
using afm::core::fail;

// Beside an installed program, share/touchafm; in a build, the source tree's assets.
std::string find_assets(const std::filesystem::path& program) {
  const std::filesystem::path installed = program.parent_path().parent_path() / "share" / "touchafm";
  std::error_code ignored;
  return std::filesystem::is_directory(installed, ignored) ? installed.string() : AFM_ASSETS_DIR;
}

// The command line would only say that a command is missing.
bool names_unknown_command(int count, char** arguments) {
  if (count < 2 || arguments[1][0] == '-') return false;
  const std::string_view name = arguments[1];
  return std::none_of(afm::app::kCommands.begin(), afm::app::kCommands.end(),
                      [name](const afm::app::Command& command) { return command.name == name; });
}

int run(int count, char** arguments) {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const afm::app::CommandContext context{.assets_dir = find_assets(program), .program_path = program.string()};

  afm::app::CommandLine command_line(
      "touchafm", afm::core::kVersion,
      "TouchAFM: feel and see the approach-retract cycle of an atomic force microscope.\n"
      "Exit codes: 0 done, 1 the run failed, 2 wrong usage, 3 bad input file, 4 a needed device is missing.");
  for (const afm::app::Command& command : afm::app::kCommands) command.add(command_line, context);

  if (names_unknown_command(count, arguments)) {
    return fail(afm::core::ExitCode::WrongUsage,
                "there is no command \"" + std::string(arguments[1]) + "\"; see touchafm --help");
  }
  const auto answer = command_line.parse(count, arguments);
  if (!answer) return fail(afm::core::ExitCode::WrongUsage, answer.error().message + "; see touchafm --help");
  if (!answer->empty()) {
    std::fputs(answer->c_str(), stdout);
    return static_cast<int>(afm::core::ExitCode::Done);
  }
  if (const auto done = command_line.run(); !done)
    return fail(afm::core::exit_code(done.error().category), done.error().message);
  return static_cast<int>(afm::core::ExitCode::Done);
}

}  // namespace

int main(int count, char** arguments) {
  return afm::core::run_main([&] { return run(count, arguments); });
}
