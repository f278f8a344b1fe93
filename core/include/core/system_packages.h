// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace afm::core {

// A part of the system that TouchAFM opens while it runs, and that a machine may lack.
enum class SystemPart { VulkanLoader, VulkanDriver, WindowLibraries, Sdl2, OpenXrLoader, EspeakNg, Fonts };

// A family of Linux distributions, by its package manager.
struct PackageSystem {
  std::string_view name;     // name of the package manager, "apt"
  std::string_view install;  // command that precedes the names of packages
};

// Text of /etc/os-release, or else of /usr/lib/os-release; empty if there is neither.
std::string read_os_release();

// Package system named by the text of an os-release file (man 5 os-release): by ID, or by the first known word of
// ID_LIKE. Null: none that we know.
const PackageSystem* package_system_of(std::string_view os_release);

// Command that installs these parts: "sudo dnf install SDL2 espeak-ng". Where `system` is null, names Debian's
// packages.
std::string install_command(const PackageSystem* system, std::span<const SystemPart> parts);

// Name of a part with its use: "SDL2 (gamepads, sound)".
std::string_view description_of(SystemPart part);

// Parts with libraries of which at least one cannot be opened here.
std::vector<SystemPart> parts_without_libraries();

}  // namespace afm::core
