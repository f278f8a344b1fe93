// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "render/image_file.h"
#include "support/live_program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/virtual_display.h"

namespace afm::app {

// A wall of three programs on one X server: the one with the hand, and two nodes. All three outputs show the same
// screen, so that their windows must show the same bytes.
constexpr std::uint32_t kWidth = 160, kHeight = 120;  // size of a window
constexpr std::uint32_t kMargin = 20;                 // space below the windows for the pointer

struct OutputPlace {
  std::uint32_t x = 0, width = kWidth, height = kHeight;
};
constexpr std::array<OutputPlace, 3> kBeside{{{0}, {kWidth}, {2 * kWidth}}};  // windows on one desktop

inline std::string wall_of_three(const std::string& left_host, const std::string& right_host,
                                 const std::array<OutputPlace, 3>& places = kBeside) {
  std::string wall = R"(
[[screen]]
name = "powerwall"
lower_left = [-1.524, 0.400, 0.0]
lower_right = [1.524, 0.400, 0.0]
upper_left = [-1.524, 2.686, 0.0]
[[node]]
name = "left"
host = ")" + left_host +
                     R"("
[[node]]
name = "right"
host = ")" + right_host +
                     R"("
[[viewer]]
name = "visitor"
ipd = "63 mm"
sweet_spot = [0.0, 1.65, 2.5]
)";
  const char* const nodes[] = {"", "node = \"left\"\n", "node = \"right\"\n"};
  for (std::uint32_t i = 0; i < 3; ++i) {
    wall += "[[output]]\nname = \"output " + std::to_string(i) + "\"\nscreen = \"powerwall\"\n" + nodes[i] +
            "mode = \"anaglyph-red-cyan\"\nrect = [" + std::to_string(places[i].x) + ", 0, " +
            std::to_string(places[i].width) + ", " + std::to_string(places[i].height) + "]\n";
  }
  return wall;
}

class ClusterWall : public ::testing::Test {
 protected:
  ClusterWall() { folder_.write("wall.toml", wall_of_three("127.0.0.1", "127.0.0.1")); }

  // without a frame budget, which would make a slow machine show coarser pictures than the others
  std::vector<std::string> node_command(const std::string& name, const std::string& address) const {
    return {support::touchafm(), "node", name, "--interface", address, "--domain", domain(), "--frame-budget", "none"};
  }
  std::vector<std::string> master_command() const {
    return {support::touchafm(),
            "view",
            "--wall",
            folder_.file("wall.toml"),
            "--cluster",
            "--domain",
            domain(),
            "--servo",
            support::servo_mode(),
            "--frame-rate",
            "12",
            "--frame-budget",
            "none"};
  }
  std::unique_ptr<support::LiveProgram> start(const std::vector<std::string>& command) const {
    return std::make_unique<support::LiveProgram>(command, display_.name());
  }
  static void expect_both_shown(support::LiveProgram& hand) {
    for (int i = 0; i < 2; ++i) {
      ASSERT_NE(hand.says_one_of({"node left shows the wall", "node right shows the wall"}), "") << hand.said();
    }
  }
  // Domain that differs between two runs of this test at the same time.
  static std::string domain() { return std::to_string(100 + ::getpid() % 100); }

  void xdotool(const std::string& command) const {
    ASSERT_EQ(
        support::run_program("env -u WAYLAND_DISPLAY DISPLAY=" + display_.name() + " xdotool " + command).exit_code, 0);
  }
  void press_at_master(const std::string& key) const {
    // focus is on the window that was opened last
    xdotool("search --name 'output 0' windowfocus --sync key " + key);
    xdotool("mousemove 5 " + std::to_string(kHeight + kMargin - 1));
  }

  // Largest difference of a byte between two windows.
  static int difference(const render::Image& all, std::uint32_t a, std::uint32_t b) {
    int largest = 0;
    for (std::size_t y = 0; y < kHeight; ++y) {
      for (std::size_t i = 0; i < 4 * kWidth; ++i) {
        const std::size_t row = 4 * y * all.width;
        largest = std::max(largest,
                           std::abs(int{all.rgba[row + 4 * a * kWidth + i]} - int{all.rgba[row + 4 * b * kWidth + i]}));
      }
    }
    return largest;
  }
  static bool is_drawn(const render::Image& all, std::uint32_t window) {
    std::size_t bright = 0;
    for (std::size_t y = 0; y < kHeight; ++y) {
      for (std::size_t x = 0; x < kWidth; ++x)
        bright += all.rgba[4 * (y * all.width + window * kWidth + x)] > 40 ? 1U : 0U;
    }
    return bright > kWidth;
  }
  // True once all windows show the same picture.
  bool all_same() const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    for (;;) {
      const render::Image seen = display_.screenshot();
      if (is_drawn(seen, 0) && difference(seen, 0, 1) == 0 && difference(seen, 0, 2) == 0) return true;
      if (std::chrono::steady_clock::now() > end) {
        (void)render::write_png(seen, support::built("cluster-windows.png"));
        return false;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }

  support::ScratchFolder folder_;
  support::VirtualDisplay display_{3 * kWidth, kHeight + kMargin};
};

}  // namespace afm::app
