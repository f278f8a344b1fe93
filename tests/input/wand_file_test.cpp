// SPDX-License-Identifier: Apache-2.0
#include "input/wand_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "input/hid_wand.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::input {
namespace wand_file_test {

using ::testing::HasSubstr;

const std::string kDevice =
    "[device]\nname = \"stick\"\nvendor = \"1234\"\nproduct = \"ab\"\n"
    "[[axis]]\naxis = \"push-x\"\nreport = 1\nbyte = 1\nscale = 127\n"
    "[[button]]\nbutton = \"select\"\nreport = 1\nbyte = 3\nbit = 2\n";

core::Result<WandFile> load(const std::string& text) {
  const support::ScratchFolder folder;
  return load_wand_file(folder.write("wand.toml", text));
}

TEST(WandFile, OfTheAssetsAreAllGood) {
  const auto mappings = load_mappings(support::source("assets/wands"));
  ASSERT_TRUE(mappings) << mappings.error().message;
  ASSERT_EQ(mappings->size(), 1U);
  EXPECT_EQ(mappings->front().vendor, 0x054c);
  const auto tracker = load_wand_file(support::source("assets/wands/dtrack.toml"));
  ASSERT_TRUE(tracker && tracker->dtrack);
  EXPECT_EQ(tracker->dtrack->address, "127.0.0.1");
  EXPECT_EQ(tracker->head_body, 0U);
  // up in the tracker is up in the room
  EXPECT_NEAR((tracker->dtrack->room_from_tracker * glm::dvec3(0, 0, 1)).y, 1.0, 1e-6);
}

TEST(WandFile, SaysWhatADeviceSends) {
  const auto file = load(kDevice + "hand = [0.1, 1.2, 2.0]\n");
  EXPECT_FALSE(file) << "hand would belong to the button";
  const auto good = load("hand = [0.1, 1.2, 2.0]\n" + kDevice);
  ASSERT_TRUE(good) << good.error().message;
  EXPECT_EQ(*good->hand_m, glm::dvec3(0.1, 1.2, 2.0));
  ASSERT_TRUE(good->device);
  EXPECT_EQ(good->device->vendor, 0x1234);
  EXPECT_EQ(good->device->product, 0x00ab);
  EXPECT_EQ(good->device->axes.front().bits, 8U);
  EXPECT_EQ(good->device->buttons.front().bit, 2U);
}

TEST(WandFile, OfAPedalNeedsNothingButStop) {
  const std::string device = "[device]\nname = \"pedal\"\nvendor = \"0c45\"\nproduct = \"7403\"\n";
  const auto pedal = load(device + "[[button]]\nbutton = \"stop\"\nreport = 0\nbyte = 3\nbit = 0\n");
  ASSERT_TRUE(pedal) << pedal.error().message;
  HidWand wand(mapped_driver(*pedal->device), {});
  const std::vector<std::uint8_t> down{0, 0, 0, 5, 0}, up{0, 0, 0, 0, 0};
  EXPECT_TRUE(wand.take(down, 1));
  EXPECT_TRUE(wand.take(up, 2));
  EXPECT_TRUE(wand.take(down, 3));
  EXPECT_TRUE(wand.take(down, 4));
  EXPECT_TRUE(wand.take(up, 5));
  const WandState state = wand.state(6);
  EXPECT_EQ(state.stops, 2U) << "a press between two frames counts";
  EXPECT_FALSE(state.orientation_valid) << "a pedal points nowhere";

  const auto mixed = load(
      device +
      "[[button]]\nbutton = \"stop\"\nreport = 0\nbyte = 3\n[[button]]\nbutton = \"grab\"\nreport = 0\nbyte = 4\n");
  ASSERT_FALSE(mixed);
  EXPECT_THAT(mixed.error().message, HasSubstr("at least one [[axis]]"));
}

struct Mistake {
  const char* from;
  const char* to;
  const char* said;
};

TEST(WandFile, NamesLineAndKeyOfEveryMistake) {
  const std::vector<Mistake> mistakes{
      {"name = \"stick\"", "name = \"\"", "line 2: device.name: must be text and not empty"},
      {"vendor = \"1234\"", "vendor = 1234", "line 3: device.vendor: must be text and not empty"},
      {"vendor = \"1234\"", "vendor = \"12345\"", "line 3: device.vendor: must be up to four hexadecimal"},
      {"product = \"ab\"\n", "", "device.product: is missing"},
      {"product = \"ab\"", "product = \"ab\"\ncolour = 1", "line 5: device.colour: unknown key; known are name"},
      {"push-x", "push-w", "line 6: axis.axis: must be push, turn, gyro or acceleration"},
      {"scale = 127", "scale = 0", "line 9: axis.scale: must not be zero"},
      {"scale = 127", "scale = nan", "line 9: axis.scale: must be a number from"},
      {"scale = 127", "scale = 127\ndead_zone = 1.0", "line 10: axis.dead_zone: must be a number from 0 to 0.9"},
      {"scale = 127", "scale = 127\nbits = 33", "line 10: axis.bits: must be a whole number from 1 to 32"},
      {"scale = 127", "scale = 127\nsigned = 1", "line 10: axis.signed: must be true or false"},
      {"report = 1\nbyte = 1", "report = 256\nbyte = 1", "line 7: axis.report: must be a whole number from 0 to 255"},
      {"report = 1\nbyte = 1", "report = 1\nbyte = 0", "line 8: axis.byte: must be a whole number from 1 to 1023"},
      {"bit = 2", "bit = 8", "line 14: button.bit: must be a whole number from 0 to 7"},
      {"\"select\"", "\"fire\"", "line 11: button.button: must be select, grab, scale, home, recenter or stop"},
      {"\"select\"", "\"grab\"", "the device needs a [[button]] with button = \"select\""},
      {"[[axis]]", "[[wheel]]", "line 5: wheel: unknown key"},
      {"[[axis]]", "[axis]", "axis: must be written [[axis]]"},
      {"[device]", "[device", "line 1: "},
  };
  for (const Mistake& mistake : mistakes) {
    std::string text = kDevice;
    const std::size_t at = text.find(mistake.from);
    ASSERT_NE(at, std::string::npos) << mistake.from;
    text.replace(at, std::string(mistake.from).size(), mistake.to);
    const auto file = load(text);
    ASSERT_FALSE(file) << mistake.to;
    EXPECT_EQ(file.error().category, core::ErrorCategory::BadInputFile);
    EXPECT_THAT(file.error().message, HasSubstr(mistake.said)) << mistake.to;
    EXPECT_THAT(file.error().message, HasSubstr("wand.toml"));
  }
}

TEST(WandFile, NamesTheMistakesOfATracker) {
  const std::string good =
      "[dtrack]\nport = 5000\nroom_from_tracker = { position = [0, 0, 0], orientation = [0, 0, 0, 1] }\n";
  ASSERT_TRUE(load(good));
  EXPECT_THAT(load("[dtrack]\nport = 0\n").error().message, HasSubstr("line 2: dtrack.port: must be a whole number"));
  EXPECT_THAT(load("[dtrack]\n").error().message, HasSubstr("dtrack.room_from_tracker: is missing"));
  std::string skewed = good;
  skewed.replace(skewed.find("[0, 0, 0, 1]"), 12, "[0, 0, 1, 1]");
  EXPECT_THAT(load(skewed).error().message,
              HasSubstr("line 3: dtrack.room_from_tracker.orientation: must be a unit quaternion"));
  EXPECT_THAT(load("").error().message, HasSubstr("the file needs hand, [dtrack] or [device]"));
  EXPECT_THAT(load("[[button]]\n").error().message, HasSubstr("the file has no [device]"));
}

TEST(WandFile, ThatIsNotThereIsNamed) {
  EXPECT_THAT(load_wand_file("/nowhere/wand.toml").error().message,
              HasSubstr("wand file /nowhere/wand.toml: cannot be read"));
}

}  // namespace wand_file_test
}  // namespace afm::input
