// SPDX-License-Identifier: Apache-2.0
#include "panels/font_finder.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "core/whole_file.h"
#include "support/scratch_folder.h"

namespace afm::render {
namespace font_finder_test {

namespace fs = std::filesystem;

constexpr const char* kDebian = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr const char* kDebianBold = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf";

std::string debian_font(const char* path) { return core::read_file(path).value(); }

TEST(FontFinder, ReadsTheFirstFolderThatHasTheFont) {
  const support::ScratchFolder empty;
  const support::ScratchFolder own;
  fs::copy_file(kDebianBold, own.file("DejaVuSans.ttf"));
  FontFinder finder({empty.path(), own.path(), fs::path(kDebian).parent_path().string()});
  EXPECT_EQ(finder.read(FontFace::DejaVu), debian_font(kDebianBold));
}

TEST(FontFinder, TakesNoOtherFileForAFont) {
  const support::ScratchFolder own;
  ASSERT_TRUE(core::write_file(own.file("DejaVuSans.ttf"), "not a font"));
  FontFinder finder({own.path(), fs::path(kDebian).parent_path().string()});
  EXPECT_EQ(finder.read(FontFace::DejaVu), debian_font(kDebian));
}

// System like Arch, whose fonts are in another folder.
TEST(FontFinder, AsksFontconfigForTheFamilyAndWeight) {
  FontFinder finder({});
  EXPECT_EQ(finder.read(FontFace::DejaVu), debian_font(kDebian));
  EXPECT_EQ(finder.read(FontFace::DejaVuBold), debian_font(kDebianBold));
  EXPECT_EQ(finder.read(FontFace::InterMedium), debian_font("/usr/share/fonts/opentype/inter/Inter-Medium.otf"));
}

TEST(FontFinder, OffersAnotherFontWithoutSerifs) {
  FontFinder finder({});
  const auto similar = finder.read_similar(FontFace::DejaVuBold);
  ASSERT_TRUE(similar);
  EXPECT_GT(similar->size(), 10'000U);
}

TEST(FontFolders, BeginWithTheProgramsOwn) {
  EXPECT_THAT(font_folders().front(), testing::EndsWith("/share/touchafm/fonts"));
}

}  // namespace font_finder_test
}  // namespace afm::render
