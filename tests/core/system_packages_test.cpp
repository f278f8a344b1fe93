// SPDX-License-Identifier: Apache-2.0
#include "core/system_packages.h"

#include <gmock/gmock.h>

#include <array>

namespace afm::core {
namespace system_packages_test {

std::string_view name_of(std::string_view os_release) {
  const PackageSystem* const system = package_system_of(os_release);
  return system == nullptr ? "none" : system->name;
}

// Lines of the files that the distributions ship.
TEST(PackageSystemOf, KnowsTheDistributionsById) {
  EXPECT_EQ(name_of("PRETTY_NAME=\"Debian GNU/Linux 12 (bookworm)\"\nVERSION_ID=\"12\"\nID=debian\n"), "apt");
  EXPECT_EQ(name_of("NAME=\"Fedora Linux\"\nID=fedora\nVERSION_ID=41\n"), "dnf");
  EXPECT_EQ(name_of("NAME=\"Arch Linux\"\nID=arch\nBUILD_ID=rolling"), "pacman");
  EXPECT_EQ(name_of("ID=\"opensuse-tumbleweed\"\nID_LIKE=\"opensuse suse\"\n"), "zypper");
  EXPECT_EQ(name_of("ID='opensuse-leap'\n"), "zypper");
}

TEST(PackageSystemOf, KnowsADerivedDistributionByWhatItIsLike) {
  EXPECT_EQ(name_of("ID=linuxmint\nID_LIKE=\"ubuntu debian\"\n"), "apt");
  EXPECT_EQ(name_of("ID=\"rocky\"\nID_LIKE=\"rhel centos fedora\"\n"), "dnf");
  EXPECT_EQ(name_of("ID=manjaro\nID_LIKE=arch\n"), "pacman");
  EXPECT_EQ(name_of("ID_LIKE=\"unheard-of arch\"\nID=new\n"), "pacman");
}

TEST(PackageSystemOf, DoesNotGuess) {
  for (const char* text :
       {"", "ID", "ID=", "ID=void\n", "VERSION_ID=debian\n", "ID=\"", "ID_LIKE=\"  \"\n", "ID=debianish"}) {
    EXPECT_EQ(name_of(text), "none") << text;
  }
}

TEST(InstallCommand, NamesThePackagesOfTheSystem) {
  constexpr std::array parts{SystemPart::Sdl2, SystemPart::EspeakNg};
  EXPECT_EQ(install_command(package_system_of("ID=debian"), parts), "sudo apt install libsdl2-2.0-0 espeak-ng");
  EXPECT_EQ(install_command(package_system_of("ID=fedora"), parts), "sudo dnf install SDL2 espeak-ng");
  EXPECT_EQ(install_command(package_system_of("ID=arch"), parts), "sudo pacman -S sdl2 espeak-ng");
  EXPECT_EQ(install_command(package_system_of("ID=opensuse-leap"), parts),
            "sudo zypper install libSDL2-2_0-0 espeak-ng");
  EXPECT_EQ(install_command(nullptr, parts), "install what Debian calls libsdl2-2.0-0 espeak-ng");
}

// The machine that builds has everything of scripts/packages.txt.
TEST(PartsWithoutLibraries, AreNoneThatTheBuildInstalls) { EXPECT_THAT(parts_without_libraries(), testing::IsEmpty()); }

}  // namespace system_packages_test
}  // namespace afm::core
