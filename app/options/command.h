// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "app/options/command_line.h"

namespace afm::app {

// Environment of a command.
struct CommandContext {
  std::string assets_dir;                // folder of models/, walls/ and materials.toml
  std::string program_path;              // path of the running program; touchafm-servo is in the same folder
  std::vector<std::string> arguments{};  // arguments as typed, without the program
  std::string language = "en";           // language of wall and report, from the locale; --language overrides it
};

// All commands, in the order of the help. Each line declares add_NAME_command, defined in a file of app/commands, and
// adds a row to kCommands.
#define AFM_FOR_EACH_COMMAND(COMMAND) \
  COMMAND(demo)                       \
  COMMAND(view)                       \
  COMMAND(node)                       \
  COMMAND(lesson)                     \
  COMMAND(curve)                      \
  COMMAND(scan)                       \
  COMMAND(generate)                   \
  COMMAND(analyse)                    \
  COMMAND(convert)                    \
  COMMAND(lever)                      \
  COMMAND(material)                   \
  COMMAND(particles)                  \
  COMMAND(paper)                      \
  COMMAND(study)                      \
  COMMAND(serve)                      \
  COMMAND(render)                     \
  COMMAND(replay)                     \
  COMMAND(wall)                       \
  COMMAND(devices)                    \
  COMMAND(doctor)                     \
  COMMAND(bench)

// Adds the command of that name with its options and action. The context must outlive the command line.
#define AFM_DECLARE_COMMAND(name) void add_##name##_command(OptionList& program, const CommandContext& context);
AFM_FOR_EACH_COMMAND(AFM_DECLARE_COMMAND)
#undef AFM_DECLARE_COMMAND

struct Command {
  std::string_view name;
  void (*add)(OptionList& program, const CommandContext& context);
};

#define AFM_COMMAND_ROW(name) Command{#name, add_##name##_command},
inline constexpr std::array kCommands{AFM_FOR_EACH_COMMAND(AFM_COMMAND_ROW)};
#undef AFM_COMMAND_ROW

}  // namespace afm::app
