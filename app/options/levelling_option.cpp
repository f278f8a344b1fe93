// SPDX-License-Identifier: Apache-2.0
#include "app/options/levelling_option.h"

#include <fmt/format.h>

#include "app/options/enum_option.h"

namespace afm::app {

std::array<Option, 2> add_channel_options(OptionList& command, std::string& channel, physics::Levelling& levelling,
                                          const std::string& channel_name) {
  Option which = command.add_option(channel_name, channel,
                                    "name of a channel of a measured image; default: the height, of the trace if there "
                                    "is one, otherwise of the retrace");
  which.type_name("NAME");
  std::string meanings;
  for (const physics::LevellingText& row : physics::kLevellings) {
    const bool changes = row.levelling != physics::Levelling::None;
    meanings += fmt::format("{}{}", meanings.empty() ? "" : ", ", row.word);
    if (changes) meanings += fmt::format(" ({})", row.meaning);
  }
  const Option level = enum_option(
      command, "--level", levelling, "a way of levelling", physics::kLevellings, &physics::LevellingText::word,
      &physics::LevellingText::levelling,
      fmt::format("levelling of a measured image: {}; default: {}", meanings, physics::text_of(levelling).word));
  return {which, level};
}

}  // namespace afm::app
