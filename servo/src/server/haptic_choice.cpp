// SPDX-License-Identifier: Apache-2.0
#include "servo/haptic_choice.h"

#include <fmt/format.h>

#include <cstdlib>
#include <utility>
#include <vector>

#include "core/log.h"
#include "haptics/recorded_device.h"
#include "servo/session_file.h"

namespace afm::servo {

namespace {

constexpr const char* kMouse = "mouse";
constexpr std::string_view kReplay = "replay:";

void log_probe(const std::vector<haptics::ProbeLine>& lines) {
  for (const haptics::ProbeLine& line : lines) core::log_line(fmt::format("haptics: {}: {}", line.subject, line.said));
  core::log_line(fmt::format("haptics: using the {}", lines.back().subject));
}

core::Result<haptics::OpenedDevice> open_recording(const std::string& file) {
  const auto session = load_session(file);
  if (!session) return tl::unexpected(session.error());
  if (!session->complete) core::log_line(cut_text(*session, file));
  std::vector<haptics::RecordedHand> hand;
  hand.reserve(session->samples.size());
  for (const scene::TipSample& sample : session->samples) {
    const auto& [x, y, z] = sample.hand_from_contact_m;
    hand.push_back({.from_contact_m = glm::dvec3(x, y, z), .turn_on = sample.turn_on != 0});
  }
  auto device = haptics::RecordedDevice::create(file, std::move(hand));
  if (!device) return tl::unexpected(device.error());
  haptics::OpenedDevice opened;
  opened.lines.push_back({"replay", true, fmt::format("{}, {} ticks", file, session->samples.size())});
  opened.device = std::move(*device);
  log_probe(opened.lines);
  return opened;
}

}  // namespace

std::vector<HapticWord> haptic_words() {
  std::vector<HapticWord> words{{"auto", "best available device, otherwise the mouse"},
                                {kMouse, "simulated hand, moved by the mouse"}};
  for (const haptics::DeviceKind& kind : haptics::device_kinds()) {
    words.push_back({std::string(kind.word), std::string(kind.meaning)});
  }
  words.push_back({std::string(kReplay) + "FILE", "recorded session"});
  return words;
}

core::Result<HapticChoice> parse_haptic_choice(std::string_view text) {
  if (text == "auto") return HapticChoice{};
  const haptics::DeviceKind& simulated = haptics::simulated_kind();
  if (text == kMouse) return HapticChoice{&simulated, {}};
  if (text.starts_with(kReplay) && text.size() > kReplay.size()) {
    return HapticChoice{&simulated, std::string(text.substr(kReplay.size()))};
  }
  if (const haptics::DeviceKind* kind = haptics::find_device_kind(text)) {
    using Person = HapticChoice::Person;
    return HapticChoice{kind, {}, kind == &simulated ? Person::Simulated : Person::Mouse};
  }
  std::string known;
  const std::vector<HapticWord> words = haptic_words();
  for (const HapticWord& word : words) {
    known += known.empty() ? "" : &word == &words.back() ? " or " : ", ";
    known += word.word;
  }
  return core::failure(core::ErrorCategory::WrongUsage,
                       fmt::format("unknown haptic device \"{}\": choose {}", text, known));
}

core::Result<haptics::OpenedDevice> open_haptic_device(const HapticChoice& choice, const core::Clock& clock,
                                                       const haptics::OfferReleasePath& offer) {
  if (!choice.replay_file.empty()) return open_recording(choice.replay_file);
  auto opened = choice.device == nullptr ? haptics::open_best_device(environment(), clock, offer)
                                         : haptics::open_device(*choice.device, environment(), clock, offer);
  if (opened && choice.device != &haptics::simulated_kind()) log_probe(opened->lines);
  return opened;
}

haptics::Environment environment() {
  return [](const char* variable) {
    const char* value = ::secure_getenv(variable);
    return value == nullptr ? std::string() : std::string(value);
  };
}

}  // namespace afm::servo
