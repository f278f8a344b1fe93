// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/options/command_line.h"
#include "app/options/enum_option.h"
#include "app/options/nearest_word.h"
#include "app/options/pixel_size_option.h"
#include "app/options/quantity_option.h"
#include "app/options/sound_options.h"
#include "app/options/uncertainty_option.h"
#include "app/options/wrapped_help.h"
#include "curves/uncertainty_text.h"
#include "exhibit/sound/synthesizer.h"

namespace afm::app {
namespace options_test {

using testing::AllOf;
using testing::HasSubstr;

class OptionsTest : public testing::Test {
 protected:
  core::Result<std::string> parse(const std::vector<const char*>& arguments) {
    std::vector<const char*> all{"program"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return command_.parse(static_cast<int>(all.size()), all.data());
  }

  // Text of a refusal; empty if there is none.
  std::string refusal(const std::string& text) {
    const auto answer = parse({"--option", text.c_str()});
    return answer ? "" : answer.error().message;
  }

  std::string help() { return parse({"--help"}).value_or(""); }

  CommandLine command_{"program", "1.2", "what it does"};
};

TEST_F(OptionsTest, TheVersionIsAnAnswerAndAnUnknownOptionWrongUsage) {
  EXPECT_EQ(parse({}), "");
  EXPECT_EQ(parse({"--version"}), "program 1.2\n");
  const auto wrong = parse({"--fast"});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().category, core::ErrorCategory::WrongUsage);
  EXPECT_THAT(wrong.error().message, HasSubstr("--fast"));
}

TEST_F(OptionsTest, ATextThatIsNoNumberIsAnsweredWithWhatTheOptionTakes) {
  double at_s = 0.0;
  command_.add_option("--option", at_s, "time of the picture").type_name("SECONDS");
  EXPECT_EQ(refusal("5s"), "--option: cannot read \"5s\" as a number that it takes; give SECONDS, without a unit");
  EXPECT_EQ(refusal("2,5"),
            "--option: cannot read \"2,5\" as a number that it takes; give SECONDS, with a decimal point and "
            "no separator of thousands");
  EXPECT_EQ(refusal("soon"), "--option: cannot read \"soon\" as a number that it takes; give SECONDS");
}

TEST_F(OptionsTest, WhatIsWrongIsSaidWithWhatToWriteInstead) {
  std::string model, file;
  int width = 0;
  bool quick = false;
  OptionList draw = command_.add_command("draw", "a picture");
  OptionList of = draw.add_alternatives("subject");
  of.add_option("--model", model, "what to draw");
  of.add_option("--file", file, "file to draw");
  const Option eye_width = draw.add_option("--eye-width", width, "width of a picture in pixels").within(64, 8192);
  draw.add_flag("--quick", quick, "in a hurry").needs(eye_width);
  command_.add_command("wall", "all screens").add_option("place", file, "where it is").required();
  const auto wrong = [&](const std::vector<const char*>& arguments) { return parse(arguments).error().message; };
  EXPECT_EQ(wrong({"draw", "--modle", "a"}),
            "program draw has no option --modle (did you mean --model?); see program draw --help");
  EXPECT_EQ(wrong({"draw", "--model", "a", "--width", "9"}),
            "program draw has no option --width (did you mean --eye-width?); see program draw --help");
  EXPECT_EQ(wrong({"draw", "--model", "a", "--fast"}), "program draw has no option --fast; see program draw --help");
  EXPECT_EQ(wrong({"draw", "--model", "a", "b"}), "program draw has no use for \"b\"; see program draw --help");
  EXPECT_EQ(wrong({"draw", "--model", "a", "--model", "b"}),
            "--model was given 2 times; give it once; see program draw --help");
  EXPECT_EQ(wrong({"draw", "--model", "a", "--eye-width"}),
            "--eye-width has no value; give NUMBER from 64 to 8192; see program draw --help");
  EXPECT_EQ(wrong({"draw", "--model", "a", "--quick"}), "--quick needs --eye-width; see program draw --help");
  EXPECT_EQ(wrong({"draw"}), "give one of --model, --file; see program draw --help");
  EXPECT_EQ(wrong({"draw", "--model", "a", "--file", "b"}),
            "give only one of --model, --file; see program draw --help");
  EXPECT_EQ(wrong({"wall"}), "the argument place is missing; see program wall --help");
  for (const auto& words : {std::vector<const char*>{"drow"}, {"drow", "--width", "3"}}) {
    EXPECT_EQ(wrong(words), "program has no command \"drow\" (did you mean draw?); see program --help");
  }
  EXPECT_EQ(wrong({}), "program needs one of its commands: draw, wall; see program --help");
}

TEST(NearestWord, IsTheOneWithTheFewestWrongLetters) {
  const std::vector<std::string> words{"view", "curve", "serve", "scan", "--tip-radius"};
  EXPECT_EQ(nearest_word("viwe", words), "view");
  EXPECT_EQ(nearest_word("curv", words), "curve");
  EXPECT_EQ(nearest_word("swerve", words), "serve");
  EXPECT_EQ(nearest_word("radius", words), "--tip-radius");
  EXPECT_EQ(nearest_word("paint", words), "");
  EXPECT_EQ(nearest_word("x", words), "");
  EXPECT_EQ(nearest_word("--", words), "");
  EXPECT_EQ(nearest_word("", words), "");
}

TEST_F(OptionsTest, OnlyTheChosenCommandRunsAndExactlyOneIsChosen) {
  std::string ran;
  OptionList first = command_.add_command("first", "one thing"), second = command_.add_command("second", "another");
  first.when_chosen([&]() -> core::Result<void> {
    ran += "first";
    return {};
  });
  second.when_chosen([]() -> core::Result<void> { return core::wrong_usage("no"); });
  EXPECT_FALSE(parse({}));
  EXPECT_EQ(parse({"first"}), "");
  EXPECT_EQ(ran, "");
  EXPECT_TRUE(command_.run());
  EXPECT_EQ(ran, "first");
  EXPECT_EQ(parse({"second"}), "");
  EXPECT_FALSE(command_.run());
  EXPECT_EQ(ran, "first");
}

TEST_F(OptionsTest, OfAlternativesExactlyOneIsGiven) {
  std::string left, right;
  OptionList hands = command_.add_alternatives("a hand");
  const Option left_hand = hands.add_option("--left", left, "the one");
  hands.add_option("--right", right, "the other");
  bool dominant = false;
  command_.add_flag("--dominant", dominant, "it writes").needs(left_hand);
  EXPECT_FALSE(parse({}));
  EXPECT_FALSE(parse({"--left", "a", "--right", "b"}));
  EXPECT_FALSE(parse({"--right", "b", "--dominant"}));
  EXPECT_FALSE(left_hand.given());
  EXPECT_TRUE(parse({"--left", "a", "--dominant"}));
  EXPECT_TRUE(left_hand.given());
  EXPECT_EQ(left, "a");
}

TEST_F(OptionsTest, AListTakesOneValueEachTimeItIsGiven) {
  std::vector<std::string> files;
  command_.add_option("--file", files, "to read").one_value_each();
  EXPECT_TRUE(parse({"--file", "a", "--file", "b"}));
  EXPECT_THAT(files, testing::ElementsAre("a", "b"));
  EXPECT_FALSE(parse({"--file", "a", "b"}));
}

TEST_F(OptionsTest, ANumberStaysWithinItsRange) {
  double seconds = 2.5;
  command_.add_option("--option", seconds, "how long").within(0.5, 600.0).show_default();
  for (const char* end : {"0.5", "600"}) EXPECT_EQ(refusal(end), "");
  for (const char* wrong : {"0.4", "601", "inf", "nan", "-NaN"}) {
    EXPECT_THAT(refusal(wrong), HasSubstr(std::string(wrong) + " is out of range; give NUMBER from 0.5 to 600"));
  }
  EXPECT_THAT(refusal("soon"), HasSubstr("cannot read \"soon\" as a number that it takes; give NUMBER from 0.5"));
  EXPECT_EQ(seconds, 600.0);
  EXPECT_THAT(help(), AllOf(HasSubstr("--option NUMBER from 0.5 to 600"), HasSubstr("how long; default: 2.5")));
}

TEST_F(OptionsTest, ANumberOutOfItsRangeIsAnsweredWithItsUnit) {
  int pixels = 0;
  command_.add_option("--option", pixels, "width").within(64, 8192).type_name("PIXELS");
  EXPECT_THAT(refusal("90000"), HasSubstr("--option: 90000 is out of range; give PIXELS from 64 to 8192; see"));
  EXPECT_THAT(refusal("90px"), HasSubstr("--option: cannot read \"90px\" as a number that it takes; give PIXELS from "
                                         "64 to 8192, without a unit; see"));
  EXPECT_THAT(refusal("90.5"), HasSubstr("give PIXELS from 64 to 8192"));
  EXPECT_EQ(refusal("8192"), "");
}

TEST_F(OptionsTest, AQuantityIsReadInSiAndRefusedWithItsUnits) {
  double read_m = 0;
  quantity_option(
      command_, "--option", [&](physics::Length length) { read_m = length.si; }, physics::kLengthUnits, "a way");
  EXPECT_EQ(refusal("50nm"), "");
  EXPECT_DOUBLE_EQ(read_m, 50e-9);
  for (const char* wrong : {"50", "50N", "nm", "nan"}) {
    EXPECT_THAT(refusal(wrong), AllOf(HasSubstr("--option"), HasSubstr("um, nm, pm"))) << wrong;
  }
  EXPECT_THAT(help(), HasSubstr("--option LENGTH in m, mm, um, nm, pm"));
}

TEST_F(OptionsTest, AQuantityOutsideItsRangeIsRefusedWithTheRange) {
  double read_m_per_s = 0;
  quantity_option(
      command_, "--option", [&](physics::Velocity speed) { read_m_per_s = speed.si; }, physics::kVelocityUnits, "haste",
      std::optional(QuantityRange<physics::Velocity>{physics::Velocity(0.005), physics::Velocity(0.2)}));
  for (const char* end : {"5mm/s", "0.2m/s"}) EXPECT_EQ(refusal(end), "");
  for (const char* wrong : {"4.9mm/s", "0.21m/s", "-1m/s"}) {
    EXPECT_THAT(refusal(wrong), HasSubstr("is outside 5mm/s to 200mm/s")) << wrong;
  }
  EXPECT_EQ(read_m_per_s, 0.2);
  EXPECT_THAT(help(), HasSubstr("--option VELOCITY from 5mm/s to 200mm/s"));
}

TEST_F(OptionsTest, AChoiceIsARowOfItsTable) {
  struct Row {
    int value;
    const char* name;
  };
  static constexpr std::array kRows{Row{7, "seven"}, Row{9, "nine"}};
  std::optional<int> chosen;
  enum_option(command_, "--option", chosen, "a lucky number", kRows, &Row::name, &Row::value, "luck");
  EXPECT_EQ(refusal("nine"), "");
  EXPECT_EQ(chosen, 9);
  EXPECT_THAT(refusal("Nine"), HasSubstr("\"Nine\" is not a lucky number; choose seven, nine"));
  EXPECT_THAT(help(), HasSubstr("--option {seven,nine}"));
}

TEST_F(OptionsTest, ASizeIsTwoNumbersWithinItsRange) {
  std::optional<glm::uvec2> size;
  pixel_size_option(command_, "--option", size, "a window", PixelRange{64, 16384});
  EXPECT_EQ(refusal("64x16384"), "");
  EXPECT_EQ(size, glm::uvec2(64, 16384));
  for (const char* wrong : {"63x64", "64x16385"}) {
    EXPECT_THAT(refusal(wrong), HasSubstr("is not WIDTHxHEIGHT in pixels of 64 to 16384 each")) << wrong;
  }
  EXPECT_THAT(help(), HasSubstr("--option WIDTHxHEIGHT from 64 to 16384 each"));
}

TEST_F(OptionsTest, AVolumeIsALevelWithItsUnit) {
  SoundOptions sound;
  add_sound_options(command_, sound);
  EXPECT_NEAR(sound.gain(), 0.501187, 1e-6) << "-6 dB";
  ASSERT_TRUE(parse({"--volume", "-20dB", "--mono-sound"}));
  EXPECT_DOUBLE_EQ(sound.gain(), 0.1);
  EXPECT_EQ(sound.channels(), exhibit::Channels::Mono);
  for (const char* text : {"-20", "20dB", "-61dB", "-20db", "nandB", "dB", "-20dBm"}) {
    const auto answer = parse({"--volume", text});
    ASSERT_FALSE(answer) << text;
    EXPECT_EQ(answer.error().category, core::ErrorCategory::WrongUsage);
    EXPECT_THAT(answer.error().message, AllOf(HasSubstr(text), HasSubstr("-60dB to 0dB with its unit")));
  }
}

TEST(WrappedHelp, BreaksBetweenWordsBelowTheDescription) {
  const std::string help =
      "what it does\n"
      "\n"
      "  --at TIME   time of the picture, in seconds; default: the start\n"
      "  --tip-radius LENGTH from 100pm to 1mm\n"
      "              radius of \u00b5m and more\n"
      "https://example.org/a/word/longer/than/the/line\n";
  EXPECT_EQ(wrapped_help(help, 200), help);
  EXPECT_EQ(wrapped_help(help, 40),
            "what it does\n"
            "\n"
            "  --at TIME   time of the picture, in\n"
            "              seconds; default: the\n"
            "              start\n"
            "  --tip-radius LENGTH from 100pm to 1mm\n"
            "              radius of \u00b5m and more\n"
            "https://example.org/a/word/longer/than/the/line\n");
  EXPECT_EQ(wrapped_help("  --at TIME   time of the picture\n", 20),
            "  --at TIME   time\n"
            "      of the picture\n");
  EXPECT_EQ(wrapped_help("a b", 1), "a\nb");
}

TEST(PixelSize, IsWidthAndHeight) {
  EXPECT_EQ(parse_pixel_size("1920x1080"), glm::uvec2(1920, 1080));
  EXPECT_EQ(parse_pixel_size("0x1"), glm::uvec2(0, 1));
  EXPECT_EQ(parse_pixel_size("64X32"), glm::uvec2(64, 32));
  EXPECT_EQ(parse_pixel_size("64\u00d732"), glm::uvec2(64, 32));
  for (const char* wrong : {"", "x", "1920", "1920x", "x1080", "1920x1080x2", "-1x5", "1920 x 1080", "1x99999999999"}) {
    EXPECT_EQ(parse_pixel_size(wrong), std::nullopt) << wrong;
  }
}

TEST_F(OptionsTest, UncertaintiesAreCollectedAndHaveAKeyEach) {
  std::vector<std::string> texts;
  uncertainty_option(command_, texts, "radius=5%", "what is uncertain");
  ASSERT_TRUE(parse({"--uncertainty", "radius=5%", "--uncertainty", "temperature=2K"}));
  const std::array keys{curves::UncertainKey{"temperature", physics::kTemperatureUnits.units},
                        curves::UncertainKey{"radius", {}}};
  const auto found = curves::parse_uncertainties(texts, keys);
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_EQ(found->size(), 2U);
  EXPECT_EQ(found->at(0).key, 1U);
  EXPECT_TRUE(found->at(0).is_share);
  EXPECT_DOUBLE_EQ(found->at(0).value, 0.05);
  EXPECT_EQ(found->at(1).key, 0U);
  EXPECT_FALSE(found->at(1).is_share);
  EXPECT_DOUBLE_EQ(found->at(1).value, 2.0);
  for (const char* wrong : {"radius", "radius=5", "radius=0%", "radius=-1%", "radius=51%", "radius=nan%", "radius=1nm",
                            "temperature=2C", "temperature=0K", "tip=5%", "=5%", ""}) {
    EXPECT_FALSE(curves::parse_uncertainties({wrong}, keys)) << wrong;
  }
  EXPECT_FALSE(curves::parse_uncertainties({"radius=5%", "radius=6%"}, keys));
}

}  // namespace options_test
}  // namespace afm::app
