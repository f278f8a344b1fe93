// SPDX-License-Identifier: Apache-2.0
// Invariant: no frame waits for the disk; no screenshot is lost; an error names its file
#include "render/screenshot_queue.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <string>
#include <thread>

#include "support/read_png.h"
#include "support/scratch_folder.h"
#include "support/vulkan_fixture.h"

namespace afm::test {
namespace screenshot_queue_test {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::size_t kMost = render::ScreenshotQueue::kMostPictures;

class PictureSaving : public VulkanTest {
 protected:
  // Every frame shows something else.
  void draw() {
    frame_.room_from_node[test_.mica][3].x += 0.05;
    renderer_.render(frame_);
  }

  std::string file(std::size_t i) const { return folder_.file(std::to_string(i) + ".png"); }

  support::ScratchFolder folder_;
  TestScene test_ = make_test_scene();
  render::FrameState frame_ = full_frame(test_);
  render::Renderer renderer_ = make_renderer(test_.scene, small());
  render::ScreenshotQueue saver_{context_, renderer_};
};

TEST_F(PictureSaving, KeepsWhatEachFrameShowedThoughOthersWereDrawnSince) {
  std::vector<render::Image> shown;
  for (std::size_t i = 0; i < kMost; ++i) {
    draw();
    ASSERT_TRUE(saver_.save({}, file(i)));
    shown.push_back(renderer_.read_composed({}));
  }
  const auto saved = saver_.finish();
  ASSERT_EQ(saved.size(), kMost);
  for (std::size_t i = 0; i < kMost; ++i) {
    EXPECT_EQ(saved[i].path, file(i));
    ASSERT_TRUE(saved[i].written) << saved[i].written.error().message;
    const auto picture = support::read_png(file(i));
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->width, shown[i].width);
    EXPECT_EQ(picture->rgba, shown[i].rgba);
  }
  EXPECT_NE(shown[0].rgba, shown[1].rgba);
}

TEST_F(PictureSaving, FollowsModesSizesAndPlacesOnTheScreen) {
  const render::Composition rows{.mode = scene::StereoMode::Row};
  const render::ReadArea area{.size_px = {100, 60}, .screen_px = {0, 1}};
  draw();
  ASSERT_TRUE(saver_.save(rows, file(0), area));
  const auto before = renderer_.read_composed(rows, area);
  ASSERT_TRUE(renderer_.resize(120, 90));
  draw();
  ASSERT_TRUE(saver_.save(rows, file(1)));
  saver_.finish();
  EXPECT_EQ(support::read_png(file(0))->rgba, before.rgba);
  EXPECT_EQ(support::read_png(file(1))->rgba, renderer_.read_composed(rows).rgba);
}

// The disk is a pipe without a reader, so that any write blocks.
TEST_F(PictureSaving, NoFrameWaitsForADiskThatHangs) {
  const std::string pipe = file(0);
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::size_t begun = 0;
  for (std::size_t i = 0; i < kMost + 3; ++i) {
    draw();
    begun += saver_.save({}, file(begun)) ? 1U : 0U;
    EXPECT_THAT(saver_.collect(), IsEmpty());
  }
  renderer_.wait();
  EXPECT_EQ(begun, kMost);  // accepted requests; the others are refused, and must wait
  EXPECT_FALSE(std::filesystem::exists(file(1)));

  std::thread reader([&] {
    const int end = ::open(pipe.c_str(), O_RDONLY | O_CLOEXEC);
    std::array<char, 65536> bytes;
    while (read(end, bytes.data(), bytes.size()) > 0) {
    }
    close(end);
  });
  const auto saved = saver_.finish();
  reader.join();
  ASSERT_EQ(saved.size(), kMost);
  for (std::size_t i = 1; i < kMost; ++i) EXPECT_TRUE(support::read_png(file(i))) << i;
  EXPECT_TRUE(saver_.save({}, file(kMost)));
}

TEST_F(PictureSaving, AnErrorNamesItsFileAndLeavesTheOthers) {
  const std::string nowhere = folder_.path() + "/missing/picture.png";
  draw();
  ASSERT_TRUE(saver_.save({}, nowhere));
  ASSERT_TRUE(saver_.save({}, file(1)));
  const auto saved = saver_.finish();
  ASSERT_EQ(saved.size(), 2U);
  ASSERT_FALSE(saved[0].written);
  EXPECT_THAT(saved[0].written.error().message, HasSubstr(nowhere));
  EXPECT_TRUE(saved[1].written);
}

TEST_F(PictureSaving, WhatIsOnItsWayAtTheEndIsWritten) {
  draw();
  {
    render::ScreenshotQueue saver(context_, renderer_);
    ASSERT_TRUE(saver.save({}, file(0)));
  }
  EXPECT_TRUE(support::read_png(file(0)));
}

TEST_F(PictureSaving, TakesTheTimeOfComposingAndReadingBack) {
  auto options = small();
  options.time_passes = true;
  auto renderer = make_renderer(test_.scene, options);
  render::ScreenshotQueue saver(context_, renderer);
  renderer.render(frame_);
  ASSERT_TRUE(saver.save({}, file(0)));
  saver.finish();
  const auto times = renderer.pass_times();
  ASSERT_TRUE(times);
  EXPECT_GT(times->compose_ms, 0.0);
  EXPECT_GT(times->readback_ms, 0.0);
}

}  // namespace screenshot_queue_test
}  // namespace afm::test
