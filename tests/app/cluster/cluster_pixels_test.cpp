// SPDX-License-Identifier: Apache-2.0
// What is on the screens of a wall of several machines, pixel by pixel: all machines' pictures are those of one, and
// change together.
// Invariant: the machines of a wall show the same bytes, in every mode, and the same frames in the same order
#include <gmock/gmock.h>
#include <sys/mman.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>

#include "app/cluster/cluster_wall.h"
#include "core/file_descriptor.h"
#include "core/fnv1a.h"
#include "core/percentiles.h"
#include "support/faulty_device.h"
#include "support/places.h"

namespace afm::app {
namespace cluster_pixels_test {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;
using ::testing::Not;

class ClusterPixels : public ClusterWall {
 protected:
  std::unique_ptr<support::LiveProgram> node(const std::string& name, const support::VirtualDisplay& display) const {
    return std::make_unique<support::LiveProgram>(node_command(name, "127.0.0.1"), display.name());
  }
  void watch(const support::VirtualDisplay& left_display, const support::VirtualDisplay& right_display,
             const char* what, const std::string& fault_of_master = {}) const;
  static void expect_orderly_end(support::LiveProgram& hand) {
    hand.signal(SIGTERM);
    EXPECT_EQ(hand.ends(), 0) << hand.said();
    EXPECT_THAT(hand.said(), Not(HasSubstr("otherwise: ")));
  }
};

// Three faces of a room in two tiles each. The machine with the hand shows all six; each node two of them.
constexpr std::uint32_t kTiles = 6, kTileWidth = 120, kTileHeight = 90;
constexpr const char* kNodeNames[] = {"left", "front", "right"};

std::string room_of_six() {
  constexpr double kCorners[][2] = {{-1.5, 1.5}, {-1.5, -1.5}, {1.5, -1.5}, {1.5, 1.5}};
  std::string screens, nodes, outputs;
  for (std::uint32_t face = 0; face < 3; ++face) {
    nodes += "[[node]]\nname = \"" + std::string(kNodeNames[face]) + "\"\nhost = \"127.0.0.1\"\n";
    const auto corner = [&](std::uint32_t i, double y) {
      return "[" + std::to_string(kCorners[i][0]) + ", " + std::to_string(y) + ", " + std::to_string(kCorners[i][1]) +
             "]\n";
    };
    for (std::uint32_t tile = 0; tile < 2; ++tile) {
      const std::uint32_t number = 2 * face + tile;
      const std::string screen = "\"screen " + std::to_string(number) + "\"\n";
      const double low = 0.4 + 1.2 * tile;
      screens += "[[screen]]\nname = " + screen + "lower_left = " + corner(face, low) +
                 "lower_right = " + corner(face + 1, low) + "upper_left = " + corner(face, low + 1.2);
      for (const bool of_node : {false, true}) {
        outputs += "[[output]]\nname = \"" + std::string(of_node ? "there " : "here ") + std::to_string(number) +
                   "\"\nscreen = " + screen + "mode = \"row\"\nrect = [" + std::to_string(number * kTileWidth) + ", " +
                   std::to_string(of_node ? kTileHeight : 0) + ", " + std::to_string(kTileWidth) + ", " +
                   std::to_string(kTileHeight) + "]\n";
        if (of_node) outputs += "node = \"" + std::string(kNodeNames[face]) + "\"\n";
      }
    }
  }
  return screens + nodes + outputs + "[[viewer]]\nname = \"visitor\"\nipd = \"63 mm\"\nsweet_spot = [0, 1.6, 0.8]\n";
}

TEST_F(ClusterPixels, SixOutputsOnThreeNodesAreThoseOfOneMachineInEveryMode) {
  const support::VirtualDisplay display(kTiles * kTileWidth, 2 * kTileHeight);
  folder_.write("wall.toml", room_of_six());
  std::vector<std::unique_ptr<support::LiveProgram>> nodes;
  for (const char* name : kNodeNames) nodes.push_back(node(name, display));
  std::vector<std::string> command = master_command();
  command.insert(command.end(), {"--haptics", "sim"});
  support::LiveProgram hand(command, display.name());
  for (std::size_t i = 0; i < nodes.size(); ++i) ASSERT_TRUE(hand.says("shows the wall")) << hand.said();

  const auto press = [&](const std::string& keys) {
    const std::string line = "env -u WAYLAND_DISPLAY DISPLAY=" + display.name() +
                             " xdotool search --name 'here 0' windowfocus --sync key " + keys;
    EXPECT_EQ(support::run_program(line).exit_code, 0);
  };
  const auto rows_differ = [&] {
    const render::Image seen = display.screenshot();
    const std::size_t half = seen.rgba.size() / 2;
    // empty walls would agree, too
    const bool drawn =
        std::count_if(seen.rgba.begin(), seen.rgba.end(), [](int byte) { return byte > 150 && byte < 255; }) > 500;
    return !drawn || !std::equal(seen.rgba.begin(), seen.rgba.begin() + static_cast<std::ptrdiff_t>(half),
                                 seen.rgba.begin() + static_cast<std::ptrdiff_t>(half));
  };
  // keys pressed one after the other on the moving wall, with each stereo mode that windows can show
  const std::vector<std::string> keys{"1",   "v",   "v F8", "v s", "v F2", "v Left", "v Up", "v g",  "v g",  "v p",
                                      "v p", "v i", "v",    "v j", "v j",  "v a",    "v a",  "v F1", "v F1", "v 2"};
  ASSERT_EQ(keys.size(), 20U);
  for (const std::string& pressed : keys) {
    hand.skip_what_it_said();
    press(pressed);
    const bool next_mode = pressed.starts_with("v");
    ASSERT_TRUE(hand.says(next_mode ? "stereo: " : "chosen: ")) << pressed << hand.said();
    const auto end = std::chrono::steady_clock::now() + seconds(20);
    bool same = false;
    while (!same && std::chrono::steady_clock::now() < end) same = !rows_differ();
    EXPECT_TRUE(same) << "after " << pressed << ": " << hand.said();
    if (!same) (void)render::write_png(display.screenshot(), support::built("cluster-tiles.png"));
  }
  expect_orderly_end(hand);
  for (const char* name : kNodeNames) {
    EXPECT_THAT(hand.said(), HasSubstr("node " + std::string(name) + ": "));
  }
  EXPECT_THAT(hand.said(), HasSubstr(" 0 built otherwise"));
  // other modes need other screens
  for (const scene::StereoModeTraits& mode : scene::kStereoModes) {
    if (mode.mode == scene::StereoMode::Dual || mode.mode == scene::StereoMode::QuadBuffer) continue;
    EXPECT_THAT(hand.said(), HasSubstr("stereo: " + std::string(mode.name) + "\n"));
  }
}

// Current pixels of an X server, read without a request.
class MappedScreen {
 public:
  explicit MappedScreen(const std::string& dump) {
    const core::FileDescriptor file(::open(dump.c_str(), O_RDONLY | O_CLOEXEC));
    const auto size = std::filesystem::file_size(dump);
    void* const memory = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, file.get(), 0);
    if (memory == MAP_FAILED) throw std::runtime_error("cannot map " + dump);
    whole_ = {static_cast<const unsigned char*>(memory), size};
    // header of an X window dump: its own size, and the colours behind it, 12 bytes each
    pixels_ = whole_.subspan(word(0) + std::size_t{12} * word(19));
    bytes_per_line_ = word(12);
  }
  MappedScreen(const MappedScreen&) = delete;
  MappedScreen& operator=(const MappedScreen&) = delete;
  ~MappedScreen() { ::munmap(const_cast<unsigned char*>(whole_.data()), whole_.size()); }

  // Digest of the upper left part. One that is read during a change differs from those of all other screens.
  std::uint64_t digest(std::uint32_t width, std::uint32_t height) const {
    std::uint64_t all = 0;
    for (std::uint32_t y = 0; y < height; ++y) {
      const auto row = pixels_.subspan(std::size_t{y} * bytes_per_line_, std::size_t{4} * width);
      all = all * 31 + core::fnv1a({reinterpret_cast<const char*>(row.data()), row.size()});
    }
    return all;
  }

  // True if that part shows only the background, which is grey, unlike text and panels.
  bool is_blank(std::uint32_t width, std::uint32_t height) const {
    for (std::uint32_t y = 0; y < height; ++y) {
      for (std::uint32_t x = 0; x < width; ++x) {
        const auto pixel = pixels_.subspan(std::size_t{y} * bytes_per_line_ + std::size_t{4} * x, 3);
        if (std::max({pixel[0], pixel[1], pixel[2]}) > kBrightest) return false;
      }
    }
    return true;
  }

 private:
  static constexpr unsigned char kBrightest = 150;  // threshold above the background, with a margin

  std::uint32_t word(std::size_t i) const {
    std::uint32_t value = 0;
    for (std::size_t byte = 0; byte < 4; ++byte) value = value << 8 | whole_[4 * i + byte];
    return value;
  }
  std::span<const unsigned char> whole_, pixels_;
  std::size_t bytes_per_line_ = 0;
};

constexpr std::size_t kMachines = 3;
constexpr std::size_t kStates = 40;  // number of states to compare

// When each state of the pictures was first seen on each screen, in the order in which it came there.
class StatesOfScreens {
 public:
  void seen(std::size_t machine, std::uint64_t state, std::chrono::steady_clock::time_point at) {
    if (!order_[machine].empty() && order_[machine].back() == state) return;
    order_[machine].push_back(state);
    first_[state][machine].emplace_back(at);
  }
  // Digests that each screen has shown exactly once, in the order in which all of them did.
  std::vector<std::uint64_t> common(std::size_t machine) const {
    std::vector<std::uint64_t> all;
    for (const std::uint64_t state : order_[machine]) {
      const auto& times = first_.at(state);
      if (std::all_of(times.begin(), times.end(), [](const auto& each) { return each.size() == 1; })) {
        all.push_back(state);
      }
    }
    return all;
  }
  std::vector<double> skews_ms() const {
    std::vector<double> all;
    for (const std::uint64_t state : common(0)) {
      const auto& times = first_.at(state);
      const auto [first, last] = std::minmax({times[0][0], times[1][0], times[2][0]});
      all.push_back(std::chrono::duration<double, std::milli>(last - first).count());
    }
    return all;
  }

 private:
  std::array<std::vector<std::uint64_t>, kMachines> order_;
  std::map<std::uint64_t, std::array<std::vector<std::chrono::steady_clock::time_point>, kMachines>> first_;
};

void print_skew(const char* what, const std::vector<double>& skews_ms) {
  const core::Percentiles p = core::percentiles(skews_ms);
  std::printf("skew of the pixels of three screens, %s: %zu times, p50 %.2f ms, p99 %.2f ms, max %.2f ms\n", what,
              skews_ms.size(), p.p50, p.p99, p.max);
}

// Lets the hand feel mica, and compares the pictures of the three screens for some seconds.
void ClusterPixels::watch(const support::VirtualDisplay& left_display, const support::VirtualDisplay& right_display,
                          const char* what, const std::string& fault_of_master) const {
  std::vector<std::string> command = master_command();
  command.insert(command.end(), {"--haptics", "sim", "--material", "mica"});
  if (!fault_of_master.empty()) command = test::on_faulty_device(fault_of_master, command);
  const auto hand = start(command);
  expect_both_shown(*hand);
  press_at_master("1");
  ASSERT_TRUE(hand->says("force on")) << hand->said();

  const MappedScreen screens[kMachines] = {MappedScreen(display_.framebuffer()),
                                           MappedScreen(left_display.framebuffer()),
                                           MappedScreen(right_display.framebuffer())};
  // a loaded machine draws few frames a second
  StatesOfScreens states;
  const auto end = std::chrono::steady_clock::now() + seconds(60);
  while (states.common(0).size() < kStates && std::chrono::steady_clock::now() < end) {
    for (int look = 0; look < 2000; ++look) {
      const auto now = std::chrono::steady_clock::now();
      for (std::size_t i = 0; i < kMachines; ++i) states.seen(i, screens[i].digest(kWidth, kHeight), now);
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
  }
  expect_orderly_end(*hand);
  EXPECT_GE(states.common(0).size(), kStates);
  EXPECT_EQ(states.common(1), states.common(0));
  EXPECT_EQ(states.common(2), states.common(0));
  print_skew(what, states.skews_ms());
}

// Monitors at 50 and at 60 Hz; the machine with the hand has a device that draws one eye after the other.
TEST_F(ClusterPixels, OtherMonitorsAndDevicesShowTheSameFramesInTheSameOrder) {
  folder_.write("wall.toml", wall_of_three("127.0.0.1", "127.0.0.1", {}));
  const support::VirtualDisplay right_display(kWidth, kHeight), left_display(kWidth, kHeight);
  const auto faulty = [&](const std::string& name, const support::VirtualDisplay& display, const std::string& fault) {
    return std::make_unique<support::LiveProgram>(test::on_faulty_device(fault, node_command(name, "127.0.0.1")),
                                                  display.name());
  };
  const auto left = faulty("left", left_display, "refresh:50"), right = faulty("right", right_display, "refresh:60");
  watch(left_display, right_display, "at 50 and 60 Hz and by another device", "one-view");
}

TEST_F(ClusterPixels, EveryScreenShowsTheSameFramesInTheSameOrder) {
  folder_.write("wall.toml", wall_of_three("127.0.0.1", "127.0.0.1", {}));
  const support::VirtualDisplay right_display(kWidth, kHeight), left_display(kWidth, kHeight);
  const auto left = node("left", left_display), right = node("right", right_display);
  watch(left_display, right_display, "frame by frame");
}

// One small screen, and one that is large and takes longer to draw: all are blank together.
TEST_F(ClusterPixels, ScreensOfOtherSizesBecomeBlankWithTheOthers) {
  constexpr std::array<OutputPlace, kMachines> kPlaces{
      {{0, kWidth, kHeight}, {0, kWidth / 2, kHeight / 2}, {0, 3 * kWidth, 3 * kHeight}}};
  folder_.write("wall.toml", wall_of_three("127.0.0.1", "127.0.0.1", kPlaces));
  const support::VirtualDisplay left_display(kWidth / 2, kHeight / 2), right_display(3 * kWidth, 3 * kHeight);
  const auto left = node("left", left_display), right = node("right", right_display);
  const auto hand = start(master_command());
  expect_both_shown(*hand);

  const MappedScreen screens[kMachines] = {MappedScreen(display_.framebuffer()),
                                           MappedScreen(left_display.framebuffer()),
                                           MappedScreen(right_display.framebuffer())};
  std::vector<double> skews_ms;
  bool blank = false;
  for (int i = 0; i < 10; ++i) {
    press_at_master("x");
    blank = !blank;
    std::array<std::optional<std::chrono::steady_clock::time_point>, kMachines> changed;
    const auto end = std::chrono::steady_clock::now() + seconds(20);
    const auto all_changed = [&] {
      return std::all_of(changed.begin(), changed.end(), [](auto& at) { return at.has_value(); });
    };
    for (auto now = std::chrono::steady_clock::now(); now < end && !all_changed();
         now = std::chrono::steady_clock::now()) {
      for (std::size_t screen = 0; screen < kMachines; ++screen) {
        // the depth at the bottom stays
        const bool is_blank = screens[screen].is_blank(kPlaces[screen].width, kPlaces[screen].height / 2);
        if (is_blank == blank && !changed[screen]) changed[screen] = now;
      }
    }
    ASSERT_TRUE(all_changed()) << "change " << i << ": " << hand->said();
    const auto [first, last] = std::minmax({*changed[0], *changed[1], *changed[2]});
    skews_ms.push_back(std::chrono::duration<double, std::milli>(last - first).count());
  }
  print_skew("of three sizes", skews_ms);
  expect_orderly_end(*hand);
}

}  // namespace cluster_pixels_test
}  // namespace afm::app
