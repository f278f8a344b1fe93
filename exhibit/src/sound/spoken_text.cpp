// SPDX-License-Identifier: Apache-2.0
#include "exhibit/sound/spoken_text.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "core/enumerators.h"
#include "exhibit/state/moment.h"

namespace afm::exhibit {

namespace {

// Prefixes from pico up, each with a singular and a plural phrase.
struct Prefix {
  double of_si;
  const char* sign;  // unit symbol for newtons
};
constexpr std::array<Prefix, 3> kPrefixes{{{1e-12, "pN"}, {1e-9, "nN"}, {1e-6, "\u00b5N"}}};
constexpr std::size_t kUsual = 1;
constexpr double kPicoBelow = 0.1, kMicroFrom = 1000.0;  // limits of the prefix nano
static_assert(after(Phrase::OnePiconewton, 2 * kPrefixes.size()) == Phrase::OnePicometre);

struct Rounded {
  std::string number;
  std::size_t prefix = kUsual;
};

Rounded rounded(double si) {
  const double two_digits = std::strtod(fmt::format("{:.1e}", std::abs(si)).c_str(), nullptr);
  const double nano = two_digits / kPrefixes[kUsual].of_si;
  Rounded result;
  if (nano > 0.0 && nano < kPicoBelow * (1.0 - 1e-9)) result.prefix = kUsual - 1;
  if (nano > kMicroFrom * (1.0 - 1e-9)) result.prefix = kUsual + 1;
  result.number = fmt::format("{:.2g}", two_digits / kPrefixes[result.prefix].of_si);
  // 2.4e+02
  if (result.number.find('e') != std::string::npos) {
    result.number = fmt::format("{:.0f}", two_digits / kPrefixes[result.prefix].of_si);
  }
  return result;
}

std::string spoken(const Phrases& phrases, double si, Phrase first) {
  const Rounded value = rounded(si);
  const std::size_t other = value.number == "1" ? 0 : 1;
  const std::array<std::string, 1> number{phrases.number(value.number)};
  return phrases.filled(after(first, 2 * value.prefix + other), number);
}

std::string filled(const Phrases& phrases, Phrase phrase, const std::string& force, const std::string& sample) {
  const std::array<std::string, 2> values{force, sample};
  return phrases.filled(phrase, values);
}

bool is_left(const Heard& heard) { return heard.event == HeardEvent::ParticleAstray && heard.force_n < 0.0; }

}  // namespace

std::string spoken_force(const Phrases& phrases, double force_n) {
  return spoken(phrases, force_n, Phrase::OnePiconewton);
}

std::string spoken_length(const Phrases& phrases, double length_m) {
  return spoken(phrases, length_m, Phrase::OnePicometre);
}

std::string shown_force(const Phrases& phrases, double force_n) {
  const Rounded value = rounded(force_n);
  return phrases.number(value.number) + " " + kPrefixes[value.prefix].sign;
}

std::string caption_of(const Phrases& phrases, const Heard& heard, const std::string& sample) {
  const Phrase caption = is_left(heard) ? Phrase::HeardAstrayLeft : row_of(heard.event).caption;
  return filled(phrases, caption, shown_force(phrases, heard.force_n), sample);
}

std::string said_of(const Phrases& phrases, const Heard& heard, const std::string& sample) {
  const Phrase said = is_left(heard) ? Phrase::SayAstrayLeft : row_of(heard.event).said;
  return filled(phrases, said, spoken_force(phrases, heard.force_n), sample);
}

std::string said_of_state(const Phrases& phrases, const scene::TipState& tip, const std::string& sample,
                          const std::string& guidance) {
  std::string said;
  const auto add = [&said](const std::string& sentence) { said += (said.empty() ? "" : ". ") + sentence; };
  if (tip.material >= 0) add(sample);
  add(phrases[state_phrase(tip.servo_state, is_stopped(tip))]);
  if (tip.servo_state == scene::ServoState::Running && tip.phase != physics::Phase::WaitForLift) {
    const std::string force = spoken_force(phrases, tip.tip.force_n);
    const bool none = tip.tip.force_n == 0.0;
    add(none                    ? phrases[Phrase::SayNoForce]
        : tip.tip.force_n < 0.0 ? phrases.text<Phrase::SayPull>(force)
                                : phrases.text<Phrase::SayPush>(force));
    const std::string height = spoken_length(phrases, tip.tip.z_m);
    add(tip.tip.z_m >= 0.0 ? phrases.text<Phrase::SayHeight>(height) : phrases.text<Phrase::SayDepth>(height));
  }
  add(guidance);
  return said;
}

}  // namespace afm::exhibit
