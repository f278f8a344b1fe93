// SPDX-License-Identifier: Apache-2.0
#include "app/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/options/menu_notice.h"
#include "app/options/nearest_word.h"
#include "app/options/standard_output.h"
#include "app/options/wrapped_help.h"
#include "core/exit_code.h"
#include "core/own_folder.h"
#include "core/run_main.h"
#include "core/version.h"
#include "exhibit/frame/exhibit_setup.h"

namespace afm::app {

namespace {

using core::fail;

std::string language_of_environment() {
  std::vector<std::string> values;
  for (const char* name : {"LC_ALL", "LC_MESSAGES", "LANG"}) {
    const char* value = ::secure_getenv(name);
    values.emplace_back(value == nullptr ? "" : value);
  }
  return exhibit::language_of_locale(values);
}

// True for an unknown command, detected here because the parser would only report a missing one.
bool names_unknown_command(int count, char** arguments) {
  if (count < 2 || arguments[1][0] == '-') return false;
  const std::string_view name = arguments[1];
  return std::none_of(kCommands.begin(), kCommands.end(),
                      [name](const Command& command) { return command.name == name; });
}

std::vector<std::string> command_names() {
  std::vector<std::string> names;
  names.reserve(std::size(kCommands));
  for (const Command& command : kCommands) names.emplace_back(command.name);
  return names;
}

}  // namespace

int run_program(int count, char** arguments, const char* commit) {
  const std::filesystem::path program = core::own_program();
  const CommandContext context{.assets_dir = core::assets_of(program).string(),
                               .program_path = program.string(),
                               .arguments = {arguments + 1, arguments + count},
                               .language = language_of_environment()};

  CommandLine command_line("touchafm", fmt::format("{} ({})", core::kVersion, commit), kProgramHelp);
  add_commands(command_line, context);

  if (names_unknown_command(count, arguments)) {
    return fail(core::ExitCode::WrongUsage, fmt::format("unknown command \"{}\"{}; see touchafm --help", arguments[1],
                                                        suggestion(arguments[1], command_names())));
  }
  const auto answer = command_line.parse(count, arguments);
  if (!answer) return fail(core::ExitCode::WrongUsage, answer.error().message);
  if (!answer->empty()) {
    const std::size_t columns = terminal_columns();
    std::fputs((columns > 0 ? wrapped_help(*answer, columns) : *answer).c_str(), stdout);
  } else if (const auto done = command_line.run(); !done) {
    tell_the_desktop(done.error().message);
    return fail(core::exit_code(done.error().category), done.error().message);
  }
  if (const auto written = flush_stdout(); !written)
    return fail(core::exit_code(written.error().category), written.error().message);
  return static_cast<int>(core::ExitCode::Done);
}

}  // namespace afm::app
