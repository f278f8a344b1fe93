// SPDX-License-Identifier: Apache-2.0
#include "app/options/levelling_option.h"

#include <fmt/format.h>

#include <cstddef>
#include <string_view>
#include <vector>

#include "app/options/enum_option.h"
#include "scene/shared/particle_blocks.h"

namespace afm::app {

namespace {

// In the order of LevelChoice::level.
constexpr std::array<std::string_view, scene::kHighestLevel + 1> kLevels{"0", "1", "2"};

std::string meanings_of_levellings() {
  std::string meanings;
  for (const physics::LevellingText& row : physics::kLevellings) {
    const bool changes = row.levelling != physics::Levelling::None;
    meanings += fmt::format("{}{}", meanings.empty() ? "" : ", ", row.word);
    if (changes) meanings += fmt::format(" ({})", row.meaning);
  }
  return meanings;
}

}  // namespace

std::array<Option, 2> add_channel_options(OptionList& command, std::string& channel, physics::Levelling& levelling,
                                          const std::string& channel_name, scene::LevelChoice* particles) {
  Option which = command.add_option(channel_name, channel,
                                    "name of a channel of a measured image; default: the height, of the trace if there "
                                    "is one, otherwise of the retrace");
  which.type_name("NAME");
  std::string help = fmt::format("levelling of a measured image: {}; default: {}", meanings_of_levellings(),
                                 physics::text_of(levelling).word);
  std::vector<std::string_view> names;
  names.reserve(physics::kLevellings.size() + kLevels.size());
  for (const physics::LevellingText& row : physics::kLevellings) names.emplace_back(row.word);
  const std::size_t levellings = names.size();
  if (particles != nullptr) {
    names.insert(names.end(), kLevels.begin(), kLevels.end());
    help +=
        ". With --particles what the wall shows: 0 (where they are, the default), 1 (where a picture has them, "
        "computed "
        "while the tip pushes, until F5 measures them again), 2 (the same while the sample drifts and pull-offs "
        "scatter)";
  }
  const auto store = [&levelling, particles, levellings](std::size_t row) {
    if (row < levellings) {
      levelling = physics::kLevellings[row].levelling;
    } else {
      particles->level = static_cast<int>(row - levellings);
    }
  };
  const std::string sort = particles != nullptr ? "a way of levelling or a level of particles" : "a way of levelling";
  return {which, choice_option(command, "--level", store, sort, names, help)};
}

}  // namespace afm::app
