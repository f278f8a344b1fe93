// SPDX-License-Identifier: Apache-2.0
#include "servo/haptic_choice.h"

#include <gmock/gmock.h>

namespace afm::servo {
namespace haptic_choice_test {

using testing::EndsWith;
using testing::HasSubstr;
using Person = HapticChoice::Person;

TEST(HapticChoice, TakesTheWordOfEveryDevice) {
  for (const haptics::DeviceKind& kind : haptics::device_kinds()) {
    const auto choice = parse_haptic_choice(kind.word);
    ASSERT_TRUE(choice) << choice.error().message;
    EXPECT_EQ(choice->device, &kind);
    EXPECT_EQ(choice->person, kind.word == "sim" ? Person::Simulated : Person::Mouse);
  }
}

TEST(HapticChoice, TakesWhatIsNoSeparateDevice) {
  EXPECT_EQ(parse_haptic_choice("auto")->device, nullptr);
  const auto mouse = parse_haptic_choice("mouse");
  EXPECT_EQ(mouse->device, &haptics::simulated_kind());
  EXPECT_EQ(mouse->person, Person::Mouse);
  EXPECT_EQ(parse_haptic_choice("replay:session.afms")->replay_file, "session.afms");
}

TEST(HapticChoice, NamesEveryWordForOneThatIsNone) {
  for (const char* none : {"", "falcon", "replay:", "HDAPI"}) {
    const auto refused = parse_haptic_choice(none);
    ASSERT_FALSE(refused) << none;
    EXPECT_EQ(refused.error().category, core::ErrorCategory::WrongUsage);
    for (const HapticWord& word : haptic_words()) EXPECT_THAT(refused.error().message, HasSubstr(word.word));
    EXPECT_THAT(refused.error().message, HasSubstr("choose auto, mouse, hdapi, "));
    EXPECT_THAT(refused.error().message, EndsWith(" or replay:FILE"));
  }
}

}  // namespace haptic_choice_test
}  // namespace afm::servo
