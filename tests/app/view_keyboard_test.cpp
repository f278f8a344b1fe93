// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "support/live_program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/virtual_display.h"

// Keys of the live window on keyboards of five layouts, by label or by place.
namespace afm::app {
namespace view_keyboard_test {

struct Pressed {
  const char* key;   // argument of xdotool: a label, or the number of the key's place
  const char* says;  // line of the log
};

constexpr const char* kStep = "parameters: ";
constexpr const char* kAnalogy = "showing Millet's analogy";
constexpr const char* kInstrument = "showing the instrument";
constexpr const char* kScale = "scale ";
constexpr const char* kNothing = "";

class KeyboardOfTheView : public ::testing::Test {
 protected:
  void try_layout(const std::string& layout, const std::vector<Pressed>& keys) {
    run("setxkbmap -layout " + layout);
    support::LiveProgram view({support::touchafm(), "view", "--size", "320x240", "--frame-rate", "12", "--eye-width",
                               "80", "--servo", support::servo_mode(), "--language", "en"},
                              display_.name());
    ASSERT_TRUE(view.says("F1 shows the keys")) << view.said();
    run("xdotool search --sync --name TouchAFM windowfocus --sync");
    run("xdotool key 10");  // place of the key 1
    ASSERT_TRUE(view.says("chosen: Mica")) << view.said();
    ASSERT_NE(view.says_one_of({"Lift", "Press Turn-On"}), "") << view.said();
    run("xdotool key F8");
    ASSERT_TRUE(view.says("between the eyes: 64 mm")) << view.said();
    for (const auto& [key, says] : keys) {
      const std::size_t before = view.said().size();
      run("xdotool key " + std::string(key) + " key F8");
      const bool answered = view.says("between the eyes: ", std::chrono::seconds(20));
      ASSERT_TRUE(answered) << layout << ", " << key << ": " << view.said();
      const std::string said = view.said().substr(before);
      EXPECT_THAT(said, ::testing::HasSubstr(says)) << layout << ", " << key;
      for (const char* const other : {kStep, kAnalogy, kInstrument, kScale, "stereo: ", "chosen: "}) {
        if (std::string_view(other) != says && !std::string_view(says).starts_with(other)) {
          EXPECT_THAT(said, ::testing::Not(::testing::HasSubstr(other))) << layout << ", " << key;
        }
      }
    }
    view.signal(SIGINT);
    EXPECT_EQ(view.ends(), 0) << view.said();
  }

  void run(const std::string& command) const {
    const auto done = support::run_program("env -u WAYLAND_DISPLAY DISPLAY=" + display_.name() + " " + command);
    ASSERT_EQ(done.exit_code, 0) << command << ": " << done.err;
  }

  support::VirtualDisplay display_{320, 240};
};

TEST_F(KeyboardOfTheView, WorksByLabelOnAUsOne) {
  try_layout("us", {{"a", kAnalogy},
                    {"a", kInstrument},
                    {"m", kScale},
                    {"plus", kStep},
                    {"equal", kStep},
                    {"minus", kStep},
                    {"KP_Add", kStep},
                    {"KP_Subtract", kStep},
                    {"KP_2", "chosen: Gold"},
                    {"1", "chosen: Mica"},
                    {"bracketright", kNothing}});
}

TEST_F(KeyboardOfTheView, WorksByLabelOnAGermanOne) {
  try_layout("de", {{"plus", kStep},
                    {"minus", kStep},
                    {"udiaeresis", kNothing},
                    {"ssharp", kNothing},
                    {"z", kNothing},
                    {"KP_Add", kStep},
                    {"2", "chosen: Gold"},
                    {"v", "stereo: "}});
}

TEST_F(KeyboardOfTheView, WorksByLabelOnAFrenchOne) {
  try_layout("fr", {{"a", kAnalogy},
                    {"a", kInstrument},
                    {"q", kNothing},
                    {"m", kScale},
                    {"comma", kNothing},
                    {"plus", kStep},
                    {"minus", kStep},
                    {"eacute", "chosen: Gold"},
                    {"1", "chosen: Mica"},
                    {"ampersand", "chosen: Mica"}});
}

// 38 is the place of a US A, 58 that of M.
TEST_F(KeyboardOfTheView, WorksByPlaceOnAGreekOneAndOnARussianOne) {
  for (const char* const layout : {"gr", "ru"}) {
    try_layout(layout, {{"38", kAnalogy},
                        {"38", kInstrument},
                        {"58", kScale},
                        {"plus", kStep},
                        {"minus", kStep},
                        {"2", "chosen: Gold"}});
  }
}

}  // namespace view_keyboard_test
}  // namespace afm::app
