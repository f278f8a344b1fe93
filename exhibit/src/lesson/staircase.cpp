// SPDX-License-Identifier: Apache-2.0
#include "exhibit/lesson/staircase.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace afm::exhibit {

UpDownStaircase::UpDownStaircase(double start, Rule rule)
    : rule_(std::move(rule)), level_(start), step_(rule_.steps.front()) {}

void UpDownStaircase::answer(bool right) {
  const bool again = any_ && before_ == right;
  const int one = right ? 1 : -1;
  same_ = again ? same_ + one : one;
  before_ = right;
  any_ = true;
  const Way at_once = right ? Way::Down : Way::Up;
  if (reversals_ == 0) {
    const bool first = way_ == Way::None || way_ == at_once;
    if (first) return move(at_once);
  }
  if (same_ >= rule_.down) return move(Way::Down);
  if (same_ <= -rule_.up) return move(Way::Up);
  // the answer that causes the first reversal already uses the later rule
  if (reversals_ == 0) {
    way_ = at_once;
    step_ = rule_.steps[std::min<std::size_t>(++reversals_, rule_.steps.size() - 1)];
  }
}

void UpDownStaircase::move(Way way) {
  if (way_ != Way::None && way_ != way) {
    ++reversals_;
    step_ = rule_.steps[std::min(reversals_, rule_.steps.size() - 1)];
  }
  way_ = way;
  same_ = 0;
  level_ = std::clamp(level_ + (way == Way::Up ? step_ : -step_), rule_.least, rule_.most);
}

void WeightedStaircase::answer(bool right) {
  wrong_once_ = wrong_once_ || !right;
  const double step = wrong_once_ ? rule_.step : 2.0 * rule_.step;
  level_ = std::clamp(level_ + (right ? -step : rule_.weight * step), rule_.least, rule_.most);
}

namespace {

constexpr double kTiny = 1e-14;  // keeps the logarithm of zero finite

std::size_t half_grid(const QuestStaircase::Rule& rule) {
  return static_cast<std::size_t>(std::ceil(0.5 * rule.range / rule.grain));
}

// Order of the quantile at which the next answer is expected to be most informative (Pelli's QuestCreate), from the
// shares of right answers far below and far above the threshold.
double best_order(double low, double high) {
  const double entropy = high * std::log(high + kTiny) - low * std::log(low + kTiny) +
                         (1.0 - high + kTiny) * std::log(1.0 - high + kTiny) -
                         (1.0 - low + kTiny) * std::log(1.0 - low + kTiny);
  const double share = 1.0 / (1.0 + std::exp(entropy / (low - high)));
  return (share - low) / (high - low);
}

}  // namespace

QuestStaircase::QuestStaircase(const Rule& rule) : rule_(rule), level_(rule.guess) {
  const std::size_t half = half_grid(rule_);
  // the level at which the Weibull function reaches the requested share
  const double weibull = (rule_.share - rule_.delta * rule_.gamma) / (1.0 - rule_.delta);
  shift_ = std::log10(-std::log((1.0 - weibull) / (1.0 - rule_.gamma))) / rule_.beta;
  const double reach = static_cast<double>(2 * half) * rule_.grain;
  order_ = best_order(right_share(-reach), right_share(reach));
  for (std::size_t i = 0; i <= 2 * half; ++i) {
    const double z = (at(i) - rule_.guess) / rule_.guess_sd;
    density_.push_back(std::exp(-0.5 * z * z));
  }
  level_ = std::clamp(rule_.guess, rule_.least, rule_.most);
}

double QuestStaircase::at(std::size_t index) const {
  return rule_.guess + (static_cast<double>(index) - static_cast<double>(half_grid(rule_))) * rule_.grain;
}

double QuestStaircase::right_share(double from_threshold) const {
  const double weibull = 1.0 - (1.0 - rule_.gamma) * std::exp(-std::pow(10.0, rule_.beta * (from_threshold + shift_)));
  return rule_.delta * rule_.gamma + (1.0 - rule_.delta) * weibull;
}

void QuestStaircase::answer(bool right) {
  // the level rounded to the grid
  const double asked = rule_.guess + std::nearbyint((level_ - rule_.guess) / rule_.grain) * rule_.grain;
  double sum = 0;
  for (std::size_t i = 0; i < density_.size(); ++i) {
    const double share = right_share(asked - at(i));
    density_[i] *= right ? share : 1.0 - share;
    sum += density_[i];
  }
  for (double& density : density_) density /= sum;
  level_ = std::clamp(quantile(), rule_.least, rule_.most);
}

double QuestStaircase::quantile() const {
  double sum = 0;
  for (const double density : density_) sum += density;
  const double wanted = order_ * sum;
  double below = 0;
  for (std::size_t i = 0; i < density_.size(); ++i) {
    const double reached = below + density_[i];
    if (reached >= wanted && density_[i] > 0.0) {
      if (i == 0) return at(0);
      return at(i - 1) + (wanted - below) / density_[i] * rule_.grain;
    }
    below = reached;
  }
  return at(density_.size() - 1);
}

std::unique_ptr<Staircase> make_staircase(const ThresholdPlan& plan) {
  const double start = std::log10(plan.start), least = std::log10(plan.least), most = std::log10(plan.most);
  const double step = std::log10(plan.step);
  switch (plan.rule) {
    case StaircaseRule::Weighted:
      break;
    case StaircaseRule::OneUpThreeDown:
      return std::make_unique<UpDownStaircase>(
          start, UpDownStaircase::Rule{
                     .up = 1, .down = 3, .steps = {4.0 * step, 2.0 * step, step}, .least = least, .most = most});
    case StaircaseRule::Quest:
      return std::make_unique<QuestStaircase>(QuestStaircase::Rule{
          .guess = start, .guess_sd = 0.5, .share = 0.75, .range = 4.0, .least = least, .most = most});
  }
  constexpr double kKaernbach = 3;  // ratio for 75 % right answers, the criterion of the 7 % threshold for forces
  return std::make_unique<WeightedStaircase>(
      start, WeightedStaircase::Rule{.step = step, .weight = kKaernbach, .least = least, .most = most});
}

}  // namespace afm::exhibit
