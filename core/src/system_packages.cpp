// SPDX-License-Identifier: Apache-2.0
#include "core/system_packages.h"

#include <dlfcn.h>

#include <algorithm>
#include <array>

#include "core/enumerators.h"
#include "core/whole_file.h"

namespace afm::core {
namespace {

using namespace std::string_view_literals;

enum Family { Apt, Dnf, Pacman, Zypper, kFamilies };

constexpr std::array<PackageSystem, kFamilies> kSystems{{
    {"apt", "sudo apt install"},
    {"dnf", "sudo dnf install"},
    {"pacman", "sudo pacman -S"},
    {"zypper", "sudo zypper install"},
}};

struct Distribution {
  std::string_view id;  // word of ID or ID_LIKE
  Family family;
};

constexpr std::array kDistributions{Distribution{"debian", Apt},      Distribution{"ubuntu", Apt},
                                    Distribution{"fedora", Dnf},      Distribution{"rhel", Dnf},
                                    Distribution{"centos", Dnf},      Distribution{"arch", Pacman},
                                    Distribution{"opensuse", Zypper}, Distribution{"suse", Zypper}};

struct Part {
  SystemPart part;
  std::string_view description;
  std::array<const char*, 5> libraries;              // required libraries; null: no further ones
  std::array<std::string_view, kFamilies> packages;  // package names in the order of Family
};

// Names of packages as in Debian 12 and 13, Fedora, Arch and openSUSE Tumbleweed.
constexpr std::array kParts{
    Part{SystemPart::VulkanLoader,
         "the Vulkan loader",
         {"libvulkan.so.1"},
         {"libvulkan1", "vulkan-loader", "vulkan-icd-loader", "libvulkan1"}},
    Part{SystemPart::VulkanDriver,
         "a Vulkan driver",
         {},
         {"mesa-vulkan-drivers", "mesa-vulkan-drivers", "vulkan-intel vulkan-radeon vulkan-swrast",
          "libvulkan_intel libvulkan_radeon libvulkan_lvp"}},
    Part{SystemPart::WindowLibraries,
         "libraries of X11 (windows)",
         {"libX11-xcb.so.1", "libXcursor.so.1", "libXi.so.6", "libXinerama.so.1", "libXrandr.so.2"},
         {"libx11-xcb1 libxcursor1 libxi6 libxinerama1 libxrandr2", "libX11-xcb libXcursor libXi libXinerama libXrandr",
          "libx11 libxcursor libxi libxinerama libxrandr", "libX11-xcb1 libXcursor1 libXi6 libXinerama1 libXrandr2"}},
    Part{SystemPart::Sdl2,
         "SDL2 (gamepads, sound)",
         {"libSDL2-2.0.so.0"},
         {"libsdl2-2.0-0", "SDL2", "sdl2", "libSDL2-2_0-0"}},
    Part{SystemPart::OpenXrLoader,
         "the OpenXR loader (headsets)",
         {"libopenxr_loader.so.1"},
         {"libopenxr-loader1", "openxr-libs", "openxr", "libopenxr_loader1"}},
    Part{SystemPart::EspeakNg, "espeak-ng (speech)", {}, {"espeak-ng", "espeak-ng", "espeak-ng", "espeak-ng"}},
    Part{SystemPart::Fonts,
         "fonts of the panels",
         {},
         {"fonts-inter fonts-dejavu-core", "rsms-inter-fonts dejavu-sans-fonts", "inter-font ttf-dejavu",
          "inter-fonts dejavu-fonts"}},
};
static_assert(has_row_for_each(kParts, &Part::part));

const Part& row_of(SystemPart part) {
  return *std::find_if(kParts.begin(), kParts.end(), [part](const Part& row) { return row.part == part; });
}

// Value of KEY=value or KEY="value"; empty if there is none.
std::string_view value_of(std::string_view text, std::string_view key) {
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    if (!line.starts_with(key) || line.size() == key.size() || line[key.size()] != '=') continue;
    line.remove_prefix(key.size() + 1);
    if (line.size() >= 2 && (line.front() == '"' || line.front() == '\'') && line.back() == line.front()) {
      line = line.substr(1, line.size() - 2);
    }
    return line;
  }
  return {};
}

// Package system for a word of ID or ID_LIKE; openSUSE's is opensuse-leap or opensuse-tumbleweed.
const PackageSystem* system_of(std::string_view word) {
  const auto* const found = std::find_if(kDistributions.begin(), kDistributions.end(), [word](const auto& row) {
    return word == row.id || (row.id == "opensuse"sv && word.starts_with("opensuse-"));
  });
  return found == kDistributions.end() ? nullptr : &kSystems[found->family];
}

bool can_be_opened(const char* library) {
  void* const opened = ::dlopen(library, RTLD_LAZY | RTLD_LOCAL);
  if (opened == nullptr) return false;
  ::dlclose(opened);
  return true;
}

}  // namespace

std::string read_os_release() {
  auto text = read_file("/etc/os-release");
  if (!text) text = read_file("/usr/lib/os-release");
  return text.value_or("");
}

const PackageSystem* package_system_of(std::string_view os_release) {
  if (const PackageSystem* const own = system_of(value_of(os_release, "ID"))) return own;
  for (std::string_view rest = value_of(os_release, "ID_LIKE"); !rest.empty();) {
    const std::string_view word = rest.substr(0, rest.find(' '));
    rest.remove_prefix(std::min(rest.size(), word.size() + 1));
    if (const PackageSystem* const similar = system_of(word)) return similar;
  }
  return nullptr;
}

std::string install_command(const PackageSystem* system, std::span<const SystemPart> parts) {
  const auto family = static_cast<std::size_t>(system == nullptr ? 0 : system - kSystems.data());
  std::string names;
  for (const SystemPart part : parts) {
    if (!names.empty()) names += ' ';
    names += row_of(part).packages[family];
  }
  if (system == nullptr) return "install what Debian calls " + names;
  return std::string(system->install) + ' ' + names;
}

std::string_view description_of(SystemPart part) { return row_of(part).description; }

std::vector<SystemPart> parts_without_libraries() {
  std::vector<SystemPart> parts;
  for (const Part& row : kParts) {
    if (!std::all_of(row.libraries.begin(), row.libraries.end(),
                     [](const char* library) { return library == nullptr || can_be_opened(library); })) {
      parts.push_back(row.part);
    }
  }
  return parts;
}

}  // namespace afm::core
