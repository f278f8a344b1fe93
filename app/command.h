// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "core/result.h"

namespace CLI {
class App;
}

namespace afm::app {

// What every command may know about its surroundings.
struct CommandContext {
  std::string assets_dir;    // folder that holds models/, walls/ and materials.toml
  std::string program_path;  // the running program; touchafm-servo lies beside it
  // set by the chosen command's callback; run by main after parsing
  std::function<core::Result<void>()> chosen;
};

// Each command adds one subcommand with its options, whose callback only stores what to run into context.chosen.
void add_analyse_command(CLI::App& app, CommandContext& context);
void add_bench_command(CLI::App& app, CommandContext& context);
void add_curve_command(CLI::App& app, CommandContext& context);
void add_demo_command(CLI::App& app, CommandContext& context);
void add_devices_command(CLI::App& app, CommandContext& context);
void add_doctor_command(CLI::App& app, CommandContext& context);
void add_material_command(CLI::App& app, CommandContext& context);
void add_paper_command(CLI::App& app, CommandContext& context);
void add_render_command(CLI::App& app, CommandContext& context);
void add_replay_command(CLI::App& app, CommandContext& context);
void add_view_command(CLI::App& app, CommandContext& context);
void add_wall_command(CLI::App& app, CommandContext& context);

}  // namespace afm::app
