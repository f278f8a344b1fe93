// SPDX-License-Identifier: Apache-2.0
#include "render/image_file.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/whole_file.h"
#include "core/written_by.h"
#include "support/pictures.h"

namespace afm::test {
namespace image_file_test {

class ImageFile : public testing::Test {
 protected:
  ImageFile() : folder_(std::filesystem::temp_directory_path() / ("afm-image-file-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~ImageFile() override { std::filesystem::remove_all(folder_); }

  static render::Image gradient() {
    render::Image image{.width = 31, .height = 7, .rgba = {}};
    for (std::uint32_t i = 0; i < image.width * image.height; ++i) {
      for (const std::uint32_t value : {i, 255 - i, i * 7, 255U}) {
        image.rgba.push_back(static_cast<std::uint8_t>(value));
      }
    }
    return image;
  }

  std::filesystem::path folder_;
};

TEST_F(ImageFile, HoldsTheSameBytes) {
  const auto path = (folder_ / "picture.png").string();
  ASSERT_TRUE(render::write_png(gradient(), path));
  const auto back = read_png(path);
  EXPECT_EQ(back.width, 31U);
  EXPECT_EQ(back.height, 7U);
  EXPECT_EQ(back.rgba, gradient().rgba);
}

TEST_F(ImageFile, NamesTheProgramAndWhatItShows) {
  const auto path = (folder_ / "picture.png").string();
  const std::vector<std::pair<std::string, std::string>> texts{{"Tip radius", "7 \u00b5m"}, {"Software", "another"}};
  ASSERT_TRUE(render::write_png(gradient(), path, texts));
  const std::string file = core::read_file(path).value(), end(5, '\0');
  EXPECT_THAT(file, testing::HasSubstr("iTXtSoftware" + end + core::written_by()));
  EXPECT_THAT(file, testing::HasSubstr("iTXtTip radius" + end + "7 \u00b5m"));
  EXPECT_THAT(file, testing::Not(testing::HasSubstr("another")));
  EXPECT_EQ(read_png(path).rgba, gradient().rgba) << "libpng checks the sums of the chunks";
}

TEST_F(ImageFile, LeavesNothingButTheWholeFile) {
  ASSERT_TRUE(render::write_png(gradient(), (folder_ / "picture.png").string()));
  ASSERT_TRUE(render::write_png(gradient(), (folder_ / "picture.png").string()));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator()), 1);
}

TEST_F(ImageFile, SaysWhichPathCannotBeWritten) {
  const auto path = (folder_ / "no-such-folder" / "picture.png").string();
  const auto written = render::write_png(gradient(), path);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().category, core::ErrorCategory::Failed);
  EXPECT_EQ(written.error().message, "cannot write " + path + ": there is no folder " +
                                         (folder_ / "no-such-folder").string() + "; make it, or choose another");
}

TEST_F(ImageFile, DoesNotReplaceAFolder) {
  const auto path = folder_ / "taken";
  std::filesystem::create_directories(path / "inside");
  EXPECT_FALSE(render::write_png(gradient(), path.string()));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator()), 1);
}

}  // namespace image_file_test
}  // namespace afm::test
