// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "app/command.h"
#include "render/context.h"

namespace afm::app {

namespace {

core::Result<void> list() {
  const auto devices = render::list_devices();
  if (!devices) return tl::unexpected(devices.error());
  for (const render::DeviceDescription& d : *devices) {
    std::printf("vulkan: %s, %s, %s: %s\n", d.name.c_str(), d.kind.c_str(), d.driver.c_str(),
                d.usable ? "usable" : ("not usable: " + d.reason).c_str());
  }
  std::printf("haptic: simulated hand: usable\n");
  std::printf("wand: simulated wand: usable\n");
  return {};
}

}  // namespace

void add_devices_command(CLI::App& app, CommandContext& context) {
  CLI::App* command =
      app.add_subcommand("devices", "list the Vulkan devices, haptic devices and wands that this program can use");
  command->footer("example: touchafm devices");
  command->callback([&context] { context.chosen = list; });
}

}  // namespace afm::app
