// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "exhibit/lesson/lesson.h"

namespace afm::exhibit {

// Chooses the level of a threshold's next trial from the answers so far. One thread.
class Staircase {
 public:
  virtual ~Staircase() = default;

  virtual double level() const = 0;
  virtual void answer(bool right) = 0;
};

// Goes up after `up` wrong answers and down after `down` right ones, by one step size after the other: the next at each
// reversal, then the last one. Until the first reversal one right answer suffices. Equals PsychoPy's StairHandler with
// applyInitialRule (Peirce et al. 2019).
class UpDownStaircase final : public Staircase {
 public:
  // Levels stay within `least` and `most`. At least one step size is required.
  struct Rule {
    int up = 1, down = 3;
    std::vector<double> steps;
    double least = 0, most = 1;
  };
  UpDownStaircase(double start, Rule rule);

  double level() const override { return level_; }
  void answer(bool right) override;

 private:
  enum class Way { None, Up, Down };
  void move(Way way);

  Rule rule_;
  double level_;
  double step_;
  Way way_ = Way::None;
  int same_ = 0;                       // number of successive right answers; negative: wrong ones
  bool before_ = false, any_ = false;  // result of the previous answer; whether there is one
  std::size_t reversals_ = 0;
};

// Goes down by `step` after every right answer, up by `weight` times as much after every wrong one. Converges to a
// fraction of right answers of weight/(1 + weight): 75 % for 3 (Kaernbach 1991). Steps are doubled until the first
// wrong answer.
class WeightedStaircase final : public Staircase {
 public:
  struct Rule {
    double step = 0.1, weight = 3;
    double least = 0, most = 1;
  };
  WeightedStaircase(double start, const Rule& rule) : rule_(rule), level_(start) {}

  double level() const override { return level_; }
  void answer(bool right) override;

 private:
  Rule rule_;
  double level_;
  bool wrong_once_ = false;
};

// QUEST (Watson & Pelli 1983, with King-Smith's quantile as in Pelli's implementation): the threshold's probability on
// a grid of levels, updated after each answer by Bayes' rule with a Weibull function.
class QuestStaircase final : public Staircase {
 public:
  struct Rule {
    double guess = 0, guess_sd = 1;  // threshold before the first answer: mean and standard deviation
    double share = 0.82;             // fraction of right answers at the threshold
    double beta = 3.5, delta = 0.01, gamma = 0.5;
    double grain = 0.01, range = 5;
    double least = -10, most = 10;  // range of the levels
  };
  explicit QuestStaircase(const Rule& rule);

  double level() const override { return level_; }
  void answer(bool right) override;

  double quantile() const;  // order of the quantile at which an answer is most informative

 private:
  double right_share(double from_threshold) const;
  double at(std::size_t index) const;  // level at a grid point

  Rule rule_;
  double shift_ = 0;  // offset from the Weibull function's zero to the threshold
  double order_ = 0.5;
  std::vector<double> density_;
  double level_;
};

// The staircase of a plan. level() is the base-10 logarithm of w.
std::unique_ptr<Staircase> make_staircase(const ThresholdPlan& plan);

}  // namespace afm::exhibit
