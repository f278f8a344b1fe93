// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "app/command.h"
#include "app/interruption.h"
#include "core/exit_code.h"
#include "core/log.h"
#include "core/version.h"

namespace {

using afm::core::ExitCode;

// Beside an installed program, share/touchafm; in a build, the source tree's assets.
std::string find_assets(const std::filesystem::path& program) {
  const std::filesystem::path installed = program.parent_path().parent_path() / "share" / "touchafm";
  std::error_code ignored;
  return std::filesystem::is_directory(installed, ignored) ? installed.string() : AFM_ASSETS_DIR;
}

int fail(afm::core::ExitCode code, const std::string& message) {
  afm::core::log_line("error: " + message);
  return static_cast<int>(code);
}

// CLI11 would only say that a subcommand is missing.
bool names_unknown_command(int count, char** arguments) {
  if (count < 2 || arguments[1][0] == '-') return false;
  const std::string_view name = arguments[1];
  return std::none_of(afm::app::kCommands.begin(), afm::app::kCommands.end(),
                      [name](const afm::app::Command& command) { return command.name == name; });
}

int run(int count, char** arguments) {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  afm::app::CommandContext context{.assets_dir = find_assets(program), .program_path = program.string(), .chosen = {}};

  CLI::App app(
      "TouchAFM: feel and see the approach-retract cycle of an atomic force microscope.\n"
      "Exit codes: 0 done, 1 the run failed, 2 wrong usage, 3 bad input file, 4 a needed device is missing.",
      "touchafm");
  app.set_version_flag("--version", std::string("touchafm ") + afm::core::kVersion);
  app.require_subcommand(1);
  for (const afm::app::Command& command : afm::app::kCommands) command.add(app, context);

  if (names_unknown_command(count, arguments)) {
    return fail(afm::core::ExitCode::WrongUsage,
                "there is no command \"" + std::string(arguments[1]) + "\"; see touchafm --help");
  }
  try {
    app.parse(count, arguments);
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& wrong) {
    return fail(afm::core::ExitCode::WrongUsage, std::string(wrong.what()) + "; see touchafm --help");
  }
  const auto done = context.chosen();
  if (!done) return fail(afm::core::exit_code(done.error().category), done.error().message);
  return static_cast<int>(afm::core::ExitCode::Done);
}

}  // namespace

int main(int count, char** arguments) {
  afm::app::catch_interruptions();
  try {
    return run(count, arguments);
  } catch (const std::exception& error) {
    // Vulkan's own failures (a lost device, no memory) and the standard library's
    return fail(afm::core::ExitCode::RunFailed, error.what());
  }
}
