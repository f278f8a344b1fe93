// SPDX-License-Identifier: Apache-2.0
#include "lesson_tapping.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "curves/contact_setup.h"
#include "physics/quantity_text.h"

namespace afm::exhibit {

namespace {

using scene::TomlTable;

constexpr std::size_t kMostLetters = 40;

// Keys of the contact's numbers: the names of the options of touchafm view, with _ for -.
constexpr std::array<std::string_view, 7> kContactKeys{
    "spring_constant", "resonance", "quality_factor", "tip_radius", "hamaker", "work_of_adhesion", "reduced_modulus"};

struct OfWord {
  bool states;
  std::string_view word;
};
constexpr std::array kIdentifies{OfWord{false, "materials"}, OfWord{true, "states"}};

// Reads a contact parameter in the form of the command line.
std::string read_contact(const TomlTable& table, std::string_view key, const std::string& option) {
  const curves::ContactParameter& parameter = *curves::find_contact_parameter(option);
  if (parameter.units.empty()) return fmt::format("{}", table.number(key, 0.0, 1e9));
  std::string text = table.text(key, kMostLetters);
  if (const auto value = curves::parse_parameter(parameter, text); !value) table.refuse(key, value.error().message);
  return text;
}

}  // namespace

curves::TappedHand read_tapping(const TomlTable& top) {
  const TomlTable table = top.table("tapping", "[tapping]");
  std::vector<std::string_view> known{"free_amplitude", "drive", "viscosity", "model"};
  known.insert(known.end(), kContactKeys.begin(), kContactKeys.end());
  table.allow_only(known);
  curves::TappedHand hand;
  hand.choice.mode = "tapping";
  table.quantity("free_amplitude", physics::kLengthUnits);
  hand.choice.numbers.free_amplitude = table.text("free_amplitude", kMostLetters);
  if (table.has("drive")) {
    table.quantity("drive", physics::kFrequencyUnits);
    hand.choice.numbers.drive = table.text("drive", kMostLetters);
  }
  if (table.has("viscosity")) hand.choice.numbers.viscosity = table.text("viscosity", kMostLetters);
  if (table.has("model")) hand.model = table.text("model", kMostLetters);
  for (const std::string_view key : kContactKeys) {
    if (!table.has(key)) continue;
    std::string option(key);
    std::replace(option.begin(), option.end(), '_', '-');
    std::string text = read_contact(table, key, option);
    hand.values.emplace(std::move(option), std::move(text));
  }
  return hand;
}

void refuse_kind_beside_tapping(const TomlTable& table, const study::StepKindRow& row, const Lesson& lesson) {
  using study::StepBeside;
  if (row.tapping == StepBeside::Needed && !lesson.tapping) {
    table.refuse("type", fmt::format("{} needs the lesson's table [tapping]", row.word));
  }
  if (row.tapping != StepBeside::Refused || !lesson.tapping) return;
  if (!row.has_cycles) table.refuse("type", fmt::format("{} is for lessons without tapping", row.word));
  table.refuse("type", fmt::format("{} compares pull-offs, which a lesson with tapping does not have; use free or "
                                   "identify with of = \"states\"",
                                   row.word));
}

bool read_states(const TomlTable& table, const Lesson& lesson) {
  const bool states = table.has("of") && table.one_of("of", kIdentifies, &OfWord::word).states;
  if (states && !lesson.tapping) table.refuse("of", "states needs the lesson's table [tapping]");
  if (!states && lesson.tapping) table.refuse("type", "identify needs of = \"states\" in a lesson with tapping");
  const std::string_view wrong = states ? "materials" : "material";
  if (table.has(wrong))
    table.refuse(wrong, fmt::format("is of no use here; write {}", states ? "material" : "materials"));
  return states;
}

}  // namespace afm::exhibit
