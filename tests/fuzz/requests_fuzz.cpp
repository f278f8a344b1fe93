// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

#include "fuzz/accepted.h"
#include "instrument/json_door.h"
#include "instrument/simulated_instrument.h"
#include "support/places.h"

namespace {

// Answers take seconds for a fuzzer's favourite numbers. An escape may hide a verb's name.
bool is_long_work(std::string_view line) {
  constexpr std::array<std::string_view, 5> kLong{"scan", "curve", "thermal", "save", "u00"};
  return std::any_of(kLong.begin(), kLong.end(),
                     [line](std::string_view verb) { return line.find(verb) != std::string_view::npos; });
}

}  // namespace

// Whatever the lines: each is answered by one JSON object on one line, and the settings remain ones that can be listed.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using afm::instrument::JsonDoor;
  // a reset would compute its sample anew for each input
  static const auto fresh = afm::instrument::SimulatedInstrument::create(afm::support::source("assets"), 1).value();
  auto instrument = fresh;
  JsonDoor door(instrument, "");
  std::string_view rest(reinterpret_cast<const char*>(bytes), size);
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    if (is_long_work(line)) continue;
    int answers = 0;
    const JsonDoor::Then then = door.answer(line, [&](std::string_view answer) {
      ++answers;
      const auto parsed = nlohmann::json::parse(answer, nullptr, false);
      if (!parsed.is_object() || !parsed.contains("ok") || answer.find('\n') != answer.size() - 1) std::abort();
      if (parsed["ok"] == true) ++afm::fuzz::accepted_inputs;
      return true;
    });
    if (answers != 1) std::abort();
    if (then == JsonDoor::Then::Quit) break;
  }
  return 0;
}
