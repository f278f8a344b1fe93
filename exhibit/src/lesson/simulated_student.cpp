// SPDX-License-Identifier: Apache-2.0
#include "exhibit/lesson/simulated_student.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "haptics/contact_model.h"
#include "haptics/simulated_device.h"
#include "physics/force_model.h"
#include "simulated_hand.h"

namespace afm::exhibit {

namespace {

constexpr double kHandMPerS = 0.05;                    // mean speed of the hand
constexpr double kTickS = 1e-3;                        // period of the servo
constexpr double kLiftM = 0.02;                        // height above the pull-off
constexpr double kPushM = 0.01;                        // depth below the surface
constexpr double kThreeQuarters = 0.6744897501960817;  // quantile of the normal distribution for 75 %
constexpr int kMostPrompts = 100'000;                  // more than in any lesson; guards against an endless one
constexpr std::uint64_t kCodeSalt = 0x9E3779B97F4A7C15ULL;

std::optional<double> number_in(std::string_view text, double least, double most) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && value >= least && value <= most ? std::optional(value) : std::nullopt;
}

struct AbilityRow {
  std::string_view name;
  double Abilities::* value;
  double least, most;
};
constexpr std::array kAbilities{AbilityRow{"d-prime", &Abilities::d_prime, 0, 10},
                                AbilityRow{"weber", &Abilities::weber_fraction, 0.001, 10},
                                AbilityRow{"bias", &Abilities::bias, -10, 10}};

// Jump of the law's branches, in the form that the servo reports for a tapping lever.
physics::EventKind kind_of_jump(physics::EventKind kind, bool taps) {
  if (!taps) return kind;
  return physics::begins_cycle(kind) ? physics::EventKind::JumpToRepulsion : physics::EventKind::JumpToAttraction;
}

core::Error bad_participant(std::string_view text) {
  return {core::ErrorCategory::WrongUsage,
          fmt::format("sim:{} is not a simulated participant; write sim:SEED, where SEED is a whole number, "
                      "or sim:SEED followed by d-prime=0 to 10, weber=0.001 to 10, bias=-10 to 10, each after a comma",
                      text)};
}

}  // namespace

core::Result<SimulatedParticipant> SimulatedParticipant::parse(std::string_view text) {
  SimulatedParticipant participant;
  std::string_view rest = text;
  const std::string_view seed = rest.substr(0, rest.find(','));
  const auto [end, error] = std::from_chars(seed.data(), seed.data() + seed.size(), participant.seed);
  if (error != std::errc() || end != seed.data() + seed.size()) return tl::unexpected(bad_participant(text));
  rest.remove_prefix(seed.size());
  while (!rest.empty()) {
    rest.remove_prefix(1);
    const std::string_view part = rest.substr(0, rest.find(','));
    rest.remove_prefix(part.size());
    const std::string_view name = part.substr(0, part.find('='));
    const auto* const row = std::find_if(kAbilities.begin(), kAbilities.end(),
                                         [&](const AbilityRow& ability) { return ability.name == name; });
    if (row == kAbilities.end() || name.size() == part.size()) return tl::unexpected(bad_participant(text));
    const auto value = number_in(part.substr(name.size() + 1), row->least, row->most);
    if (!value) return tl::unexpected(bad_participant(text));
    participant.abilities.*(row->value) = *value;
  }
  return participant;
}

std::string SimulatedParticipant::code() const {
  LessonRandom random(seed ^ kCodeSalt);
  std::string code;
  for (int i = 0; i < 6; ++i) code += static_cast<char>('A' + random.below(26));
  return code;
}

std::string SimulatedParticipant::json() const {
  const nlohmann::ordered_json observer{{"seed", seed},
                                        {"d_prime", abilities.d_prime},
                                        {"weber_fraction", abilities.weber_fraction},
                                        {"bias", abilities.bias}};
  return observer.dump();
}

SimulatedStudent::SimulatedStudent(const SimulatedParticipant& participant, const Lesson& lesson,
                                   std::span<const curves::SampleModel> samples)
    : abilities_(participant.abilities),
      seed_(participant.seed),
      particles_(lesson.set.get()),
      scale_(lesson.scale),
      samples_(samples),
      random_(participant.seed),
      normal_(participant.seed) {}

SimulatedStudent::~SimulatedStudent() = default;

core::Result<void> SimulatedStudent::take(LessonRun& run) {
  const haptics::SimulatedDevice device;
  std::vector<std::shared_ptr<const physics::LawTables>> tables;
  for (const curves::SampleModel& sample : samples_) tables.push_back(sample.tables);
  const auto common = haptics::Scaling::common_scale(tables, device.spec());
  if (!common) return tl::unexpected(common.error());
  common_ = *common;
  for (int i = 0; i < kMostPrompts; ++i) {
    if (run.error()) return tl::unexpected(*run.error());
    const LessonPrompt prompt = run.prompt(now_s_);
    switch (prompt.wants) {
      case LessonPrompt::Wants::Nothing:
        return {};
      case LessonPrompt::Wants::GoOn:
        now_s_ += 5.0 + 10.0 * random_.unit();  // time for reading
        run.go_on(now_s_);
        break;
      case LessonPrompt::Wants::Cycle:
        if (auto felt = feel(run, prompt); !felt) return felt;
        break;
      case LessonPrompt::Wants::Push:
      case LessonPrompt::Wants::Write:
        if (auto taken = take_step(run); !taken) return taken;
        break;
      case LessonPrompt::Wants::Answer: {
        const std::size_t answer = choose(prompt);
        now_s_ += 0.5 + 2.0 * random_.unit();
        run.answer(answer, now_s_);
        break;
      }
    }
  }
  return core::failure(core::ErrorCategory::Failed, "the simulated participant finds no end to this lesson");
}

core::Result<void> SimulatedStudent::take_step(LessonRun& run) {
  if (!hand_) {
    auto hand = SimulatedHand::create(samples_.front(), *particles_, seed_);
    if (!hand) return tl::unexpected(hand.error());
    hand_ = std::move(*hand);
  }
  return hand_->take_step(run, now_s_);
}

// Feels one cycle with the servo's model, tick by tick; in tapping mode, with its push at rest.
core::Result<void> SimulatedStudent::feel(LessonRun& run, const LessonPrompt& prompt) {
  const std::size_t material = prompt.material.value_or(random_.below(samples_.size()));
  std::shared_ptr<const physics::LawTables> tables = samples_[material].tables;
  const haptics::DeviceSpec device = haptics::SimulatedDevice().spec();
  if (prompt.variant) {
    auto built = haptics::build_tables(*prompt.variant, {});
    if (!built) return tl::unexpected(built.error());
    tables = std::move(*built);
  }
  const auto scaling = scale_ == scene::ScaleMode::Common ? haptics::Scaling::common(*tables, device, common_)
                       : scale_ == scene::ScaleMode::Compressed
                           ? haptics::Scaling::compressed(std::array{tables}, device)
                           : haptics::Scaling::fit(*tables, device);
  if (!scaling) return tl::unexpected(scaling.error());
  now_s_ += 2.0 + 2.0 * random_.unit();  // time for lifting and for enabling the force
  run.force_is(prompt.condition == Condition::Picture ? HandForce::None : HandForce::Full, now_s_);
  const double high_m = scaling->release_height_m() + kLiftM;
  const double low_m = scaling->hand_height_m(0.0) - kPushM;
  const auto strokes = static_cast<std::int64_t>(std::ceil((high_m - low_m) / (kHandMPerS * kTickS)));
  physics::ApproachRetractModel model(tables);
  for (std::int64_t tick = 0; tick <= 2 * strokes; ++tick) {
    const double share = static_cast<double>(std::abs(tick - strokes)) / static_cast<double>(strokes);
    const double z_m = scaling->z_m(low_m + share * (high_m - low_m));
    const physics::TipResponse response = model.step(physics::Length(z_m));
    for (std::uint32_t i = 0; i < response.event_count; ++i) {
      const physics::ModelEvent& event = response.events[i];
      if (event.kind == physics::EventKind::JumpOffContact) {
        felt_n_[0] = std::exchange(felt_n_[1], -scaling->hand_force_n(event.force_before.si));
      }
      const double at_s = now_s_ + (static_cast<double>(tick) - 1.0 + event.fraction) * kTickS;
      run.happened({.kind = kind_of_jump(event.kind, samples_[material].taps()),
                    .material = static_cast<std::int32_t>(material),
                    .time_ns = static_cast<std::int64_t>(at_s * 1e9),
                    .z_m = event.z.si,
                    .force_before_n = event.force_before.si,
                    .force_after_n = event.force_after.si},
                   at_s);
    }
    if (!prompt.of_states) continue;
    const double at_s = now_s_ + static_cast<double>(tick) * kTickS;
    scene::TipSample sample;
    sample.time_ns = static_cast<std::int64_t>(at_s * 1e9);
    sample.material = static_cast<std::int32_t>(material);
    sample.phase = response.phase;
    sample.tip.z_m = z_m;
    run.add(sample, at_s);
    if (run.prompt(at_s).wants == LessonPrompt::Wants::Cycle) continue;
    // the question ends the cycle
    now_s_ = at_s;
    return {};
  }
  now_s_ += static_cast<double>(2 * strokes) * kTickS;
  return {};
}

std::size_t SimulatedStudent::choose(const LessonPrompt& prompt) {
  if (!prompt.has_right) return rate(prompt);
  constexpr double kKnown = 0.8;  // probability of knowing the answer, such as a part of the curve
  if (prompt.kind == StepKind::Threshold) return stronger_of_two();
  if (prompt.kind == StepKind::Identify) return identify(prompt);
  return random_.unit() < kKnown ? prompt.right : random_.below(prompt.answers.size());
}

std::size_t SimulatedStudent::rate(const LessonPrompt& prompt) {
  if (prompt.item.empty()) return 0;  // consent, or continuation after a break
  if (prompt.item.starts_with("ssq-")) {
    // at most two slight symptoms, far below the rule that stops a lesson
    const bool may = prompt.item == "ssq-2" || prompt.item == "ssq-4";
    return may && random_.unit() < 0.3 ? 1 : 0;
  }
  // from the middle to the upper end
  const std::size_t middle = prompt.answers.size() / 2;
  return middle + random_.below(prompt.answers.size() - middle);
}

// Compares by the difference relative to the weaker force, with noise that makes three of four answers right at the
// Weber fraction.
std::size_t SimulatedStudent::stronger_of_two() {
  const double sigma = abilities_.weber_fraction / (std::sqrt(2.0) * kThreeQuarters);
  const double share = (felt_n_[1] - felt_n_[0]) / std::min(felt_n_[0], felt_n_[1]);
  return share / sigma + std::sqrt(2.0) * normal_() > abilities_.bias ? 1 : 0;
}

// Gives each material a noisy likeness, larger by d' for the one shown; the largest wins.
std::size_t SimulatedStudent::identify(const LessonPrompt& prompt) {
  std::size_t best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < prompt.answers.size(); ++i) {
    const double likeness =
        normal_() + (i == prompt.right ? abilities_.d_prime : 0.0) + (i == 0 ? abilities_.bias : 0.0);
    if (likeness <= most) continue;
    most = likeness;
    best = i;
  }
  return best;
}

}  // namespace afm::exhibit
