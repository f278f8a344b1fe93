// SPDX-License-Identifier: Apache-2.0
#include "physics/tapping/averaged_flow.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "tapping/swing_shape.h"

namespace afm::physics {
namespace {

constexpr double kLeastAmplitude = 1e-15;  // smallest amplitude with a meaningful phase, m
constexpr double kShiftError = 1e-17;      // absolute error of a shift, m
constexpr double kShiftShare = 1e-7;       // error of a shift, as a fraction of it
constexpr double kCoarse = 300.0;          // errors of averages that no derivative is taken of, in those of the others
constexpr double kLeastSlope = -0.2;       // slope of <F G>/k - x; no step is longer than five times what is missing
constexpr double kHopelessShift = -1.0;    // shift below which no search that falls has returned, m

// At the resonance every felt swing is that of earlier versions.
bool answers_at_drive(AveragedFlow::Search search, const DrivenLever& lever) {
  return search == AveragedFlow::Search::Exact || (lever.harmonics == Harmonics::OfTheDrive && lever.ratio != 1.0);
}

}  // namespace

AveragedFlow::AveragedFlow(std::shared_ptr<const TapSurface> surface, const DrivenLever& lever, Search search)
    : surface_(std::move(surface)),
      lever_(lever),
      search_(search),
      answers_at_drive_(answers_at_drive(search, lever)),
      k_(lever.spring_constant.si),
      a_(lever.base_amplitude.si),
      r_(lever.ratio),
      q_(lever.quality_factor),
      harmonics_ratio_(answers_at_drive_ ? lever.ratio : 1.0),
      shape_(std::make_unique<SwingShape>(HarmonicResponse(k_, harmonics_ratio_), answers_at_drive_)) {}

AveragedFlow::~AveragedFlow() = default;

const SwingAverages& AveragedFlow::averages(Length amplitude, Length z) noexcept {
  return averages_at(amplitude.si, z.si, kCoarse);
}

const SwingAverages& AveragedFlow::averages_at(double amplitude, double z, double coarseness) noexcept {
  has_shape_ = bent_averages_at(amplitude, z, coarseness);
  if (!has_shape_) straight_averages_at(amplitude, z);
  return averages_;
}

Energy AveragedFlow::lost() const noexcept {
  // of the harmonics, each n^2 A_n^2 pi k r/Q
  return averages_.lost + Energy(2.0 * std::numbers::pi * k_ * r_ / q_ * shape_->mean_square_rate());
}

// Secant steps on <F G>/k - x, while the shape of the swing follows.
bool AveragedFlow::bent_averages_at(double amplitude, double z, double coarseness) noexcept {
  constexpr int kMostSteps = 40;
  constexpr double kShapeShare = 0.1;
  double x = shift_, before = x, missing_before = 0.0, slope = -1.0;
  for (int i = 0; i < kMostSteps; ++i) {
    averages_ =
        surface_->averages({Length(amplitude), Length(z + x), lever_.angular_drive(), harmonics_ratio_}, shape_.get());
    const double bend_error = shape_->finish();
    const double missing = averages_.shift_at_lowest.si / k_ - x;
    const double bound = coarseness * (kShiftError + kShiftShare * std::abs(x));
    if (std::abs(missing) < bound && bend_error < bound) {
      shift_ = x;
      return true;
    }
    if (!std::isfinite(missing) || (x < kHopelessShift && missing < 0.0)) break;
    // x waits for the shape, so that the slope is its own
    if (bend_error > std::max(bound, kShapeShare * std::abs(missing))) continue;
    if (x != before) slope = std::min((missing - missing_before) / (x - before), kLeastSlope);
    before = std::exchange(x, x - missing / slope);
    missing_before = missing;
  }
  return false;
}

// A contact so stiff that its swing has no shape: only the lowest point is shifted.
void AveragedFlow::straight_averages_at(double amplitude, double z) noexcept {
  constexpr int kMostSteps = 12;
  shape_->straighten();
  // secant steps on <F G>/k - x
  double x = std::isfinite(shift_) ? shift_ : 0.0, before = 0.0, missing_before = 0.0;
  for (int i = 0; i < kMostSteps; ++i) {
    averages_ = surface_->averages({Length(amplitude), Length(z + x), lever_.angular_drive(), harmonics_ratio_});
    const double missing = averages_.shift_at_lowest.si / k_ - x;
    shift_ = x;
    if (std::abs(missing) < kShiftError + kShiftShare * std::abs(x)) break;
    double slope = i == 0 ? -1.0 : (missing - missing_before) / (x - before);
    if (!(slope < kLeastSlope)) slope = -1.0;
    before = std::exchange(x, x - missing / slope);
    missing_before = missing;
  }
}

AveragedFlow::Rate AveragedFlow::rate(const TapState& state, double z) noexcept {
  const double amplitude = std::max(state.amplitude.si, kLeastAmplitude);
  const SwingAverages& swing = averages_at(amplitude, z);
  return {-amplitude / (2.0 * q_) + a_ / (2.0 * r_) * std::sin(state.phase) -
              lost().si / (2.0 * std::numbers::pi * k_ * r_ * amplitude),
          (r_ * r_ - 1.0) / (2.0 * r_) + a_ / (2.0 * r_ * amplitude) * std::cos(state.phase) +
              swing.virial.si / (r_ * k_ * amplitude * amplitude)};
}

void AveragedFlow::step(TapState& state, Length z, double angle) noexcept {
  const Rate first = rate(state, z.si);
  const TapState middle{Length(state.amplitude.si + 0.5 * angle * first.amplitude),
                        state.phase + 0.5 * angle * first.phase};
  const Rate second = rate(middle, z.si);
  state.amplitude = Length(std::max(kLeastAmplitude, state.amplitude.si + angle * second.amplitude));
  state.phase += angle * second.phase;
}

// The phase that holds a resting swing whose averages were computed last.
double AveragedFlow::sine_of_rest(double amplitude) const noexcept {
  return r_ * amplitude / (q_ * a_) + lost().si / (std::numbers::pi * k_ * a_ * amplitude);
}
double AveragedFlow::cosine_of_rest(double amplitude) const noexcept {
  return (1.0 - r_ * r_ - 2.0 * averages_.virial.si / (k_ * amplitude * amplitude)) * amplitude / a_;
}

double AveragedFlow::imbalance_of(double amplitude) const noexcept {
  const double sine = sine_of_rest(amplitude), cosine = cosine_of_rest(amplitude);
  return sine * sine + cosine * cosine - 1.0;
}

double AveragedFlow::imbalance(double amplitude, double z) noexcept {
  averages_at(amplitude, z);
  return imbalance_of(amplitude);
}

RestingTap AveragedFlow::describe(const TapState& state, Length z) noexcept {
  RestingTap tap{.state = state, .deflection = {}, .averages = {}, .stable = linear(state, z.si).stable()};
  tap.averages = averages_;
  tap.deflection = tap.averages.mean / lever_.spring_constant;
  return tap;
}

AveragedFlow::Linear AveragedFlow::linear(const TapState& state, double z) noexcept {
  const double amplitude = std::max(state.amplitude.si, kLeastAmplitude), length = 1e-6 * amplitude;
  const Rate longer = rate({Length(amplitude + length), state.phase}, z);
  const Rate here = rate(state, z);  // computes the newest averages
  return {.rate = here,
          .amplitude_by_amplitude = (longer.amplitude - here.amplitude) / length,
          .amplitude_by_phase = a_ / (2.0 * r_) * std::cos(state.phase),
          .phase_by_amplitude = (longer.phase - here.phase) / length,
          .phase_by_phase = -a_ / (2.0 * r_ * amplitude) * std::sin(state.phase)};
}

bool AveragedFlow::follow(TapState& state, Length z) noexcept {
  constexpr int kMostSteps = 12;
  constexpr double kFarthest = 0.05;  // step in phase, or in relative amplitude, that leads to another branch
  TapState next = state;
  for (int i = 0; i < kMostSteps; ++i) {
    const Linear at = linear(next, z.si);
    const double determinant = at.determinant();
    const double da = (at.amplitude_by_phase * at.rate.phase - at.phase_by_phase * at.rate.amplitude) / determinant;
    const double dp =
        (at.phase_by_amplitude * at.rate.amplitude - at.amplitude_by_amplitude * at.rate.phase) / determinant;
    next.amplitude = next.amplitude + Length(da);
    next.phase += dp;
    const bool near = std::abs(next.phase - state.phase) < kFarthest &&
                      std::abs((next.amplitude - state.amplitude).si) < kFarthest * state.amplitude.si;
    if (!near || !at.stable()) return false;
    if (std::abs(da) < 1e-10 * next.amplitude.si && std::abs(dp) < 1e-10) {
      state = next;
      return true;
    }
  }
  return false;
}

RestingTap AveragedFlow::settle(const TapState& from, Length z) {
  constexpr int kMostSteps = 300, kBetweenTries = 20;
  TapState state = from;
  if (follow(state, z)) return describe(state, z);
  for (int i = 1; i <= kMostSteps; ++i) {
    step(state, z, longest_step());
    if (i % kBetweenTries == 0 && follow(state, z)) return describe(state, z);
  }
  // a contact too stiff for the steps of the flow, or a law with a step at contact, about which the swing hovers
  RestingTap nearest = describe(state, z);
  double least = HUGE_VAL;
  for (const RestingTap& tap : resting_at(z, Roots::Slow)) {
    const double distance = std::abs(tap.state.phase - state.phase) +
                            std::abs((tap.state.amplitude - state.amplitude).si) / lever_.free_amplitude.si;
    if (!tap.stable || distance >= least) continue;
    least = distance;
    nearest = tap;
  }
  return nearest;
}

double AveragedFlow::amplitude_at_lowest(double lowest, double z) noexcept {
  constexpr int kMostSteps = 24;
  // A = Z + x - lowest with the shift x of that swing; from the previous one, then from a free one
  for (const bool afresh : {false, true}) {
    if (afresh) {
      shape_->straighten();
      shift_ = 0.0;
    }
    for (int i = 0; i < kMostSteps; ++i) {
      const double amplitude = std::max(kLeastAmplitude, z + shift_ - lowest);
      averages_ = surface_->averages(
          {Length(amplitude), Length(lowest + amplitude), lever_.angular_drive(), harmonics_ratio_}, shape_.get());
      const double bend_error = shape_->finish(), shift = averages_.shift_at_lowest.si / k_;
      const bool done = std::abs(shift - shift_) < 1e-14 && bend_error < 1e-14;
      shift_ = shift;
      if (done && z + shift_ - lowest > kLeastAmplitude) return z + shift_ - lowest;
      if (!std::isfinite(shift)) break;
    }
  }
  return z + shift_ - lowest;
}

AveragedFlow::Sample AveragedFlow::sample_at(double lowest, double z) noexcept {
  const double amplitude = amplitude_at_lowest(lowest, z);
  return {lowest, amplitude <= kLeastAmplitude ? -1.0 : imbalance(amplitude, z)};
}

// Sample to 1e-13 m: enough for a sign. The averages are those of the search itself where it has converged.
AveragedFlow::Sample AveragedFlow::rough_sample_at(double lowest, double z) noexcept {
  constexpr int kMostSteps = 24;
  constexpr double kError = 1e-13;
  for (int i = 0; i < kMostSteps; ++i) {
    const double amplitude = std::max(kLeastAmplitude, z + shift_ - lowest);
    averages_ = surface_->averages(
        {Length(amplitude), Length(lowest + amplitude), lever_.angular_drive(), harmonics_ratio_}, shape_.get());
    const double bend_error = shape_->finish(), shift = averages_.shift_at_lowest.si / k_;
    const double missing = shift - shift_;
    shift_ = shift;
    if (!std::isfinite(shift)) break;
    if (std::abs(missing) > kError || bend_error > kError) continue;
    if (amplitude <= kLeastAmplitude) break;
    return {lowest, imbalance_of(amplitude)};
  }
  return sample_at(lowest, z);
}

std::vector<AveragedFlow::Sample> AveragedFlow::samples_at(double z, Roots roots) {
  constexpr double kFinest = 4e-12, kGrowth = 1.12;  // finest step in m, growth of a step; dense where contact begins
  constexpr double kHopeless = 30.0;                 // imbalance of a push far beyond what the drive sustains
  constexpr int kSeen = 6;                           // number of successive ones, as a swing may have lost its shape
  const double contact = surface_->contact_height().si;
  std::vector<double> heights;
  for (double d = kFinest; contact + d < z; d *= kGrowth) heights.push_back(contact + d);
  std::reverse(heights.begin(), heights.end());
  heights.push_back(contact);
  std::vector<Sample> samples;
  samples.reserve(heights.size());
  const auto look_at = [&](double lowest) {
    return roots == Roots::Quick ? rough_sample_at(lowest, z) : sample_at(lowest, z);
  };
  shift_ = 0.0;
  for (const double lowest : heights) samples.push_back(look_at(lowest));
  const double deepest = std::max(z, 4.0 * lever_.free_amplitude.si);
  int hopeless = 0;
  for (double d = kFinest; d < deepest; d *= kGrowth) {
    samples.push_back(look_at(contact - d));
    hopeless = averages_.virial.si < 0.0 && samples.back().imbalance > kHopeless ? hopeless + 1 : 0;
    if (hopeless == kSeen) break;
  }
  return samples;
}

RestingTap AveragedFlow::root_between(Sample one, Sample other, double z) noexcept {
  for (int i = 0; i < 80 && std::abs(one.lowest - other.lowest) > 1e-20; ++i) {
    // false position, halved where it stalls
    double at = 0.5 * (one.lowest + other.lowest);
    if (i % 3 != 2) {
      at = one.lowest - one.imbalance * (other.lowest - one.lowest) / (other.imbalance - one.imbalance);
    }
    const Sample middle = sample_at(at, z);
    if (middle.imbalance == 0.0) {
      one = middle;
      break;
    }
    ((middle.imbalance < 0.0) == (one.imbalance < 0.0) ? one : other) = middle;
  }
  const double amplitude = std::max(kLeastAmplitude, amplitude_at_lowest(one.lowest, z));
  averages_at(amplitude, z);
  return describe({Length(amplitude), std::atan2(sine_of_rest(amplitude), cosine_of_rest(amplitude))}, Length(z));
}

// A sample with the other sign between two of the same, by golden section; the middle one itself if there is none.
AveragedFlow::Sample AveragedFlow::turn_between(const Sample& left, const Sample& middle, const Sample& right,
                                                double z) noexcept {
  const double sign = middle.imbalance < 0.0 ? -1.0 : 1.0;
  const bool bends_back = sign * middle.imbalance < sign * left.imbalance &&
                          sign * middle.imbalance <= sign * right.imbalance && sign * right.imbalance > 0.0;
  if (!bends_back) return middle;
  double from = left.lowest, to = right.lowest;
  Sample turn = middle;
  for (int i = 0; i < 40 && sign * turn.imbalance > 0.0; ++i) {
    const Sample a = sample_at(to - 0.618 * (to - from), z), b = sample_at(from + 0.618 * (to - from), z);
    const bool first_half = sign * a.imbalance < sign * b.imbalance;
    (first_half ? to : from) = first_half ? b.lowest : a.lowest;
    turn = first_half ? a : b;
  }
  return turn;
}

// The tip on the sample, whose adhesion holds a lever that pulls: there it is a driven oscillator with the contact as a
// second spring.
std::optional<RestingTap> AveragedFlow::stuck_at(double z) noexcept {
  constexpr double kProbe = 1e-14;  // amplitude of a swing that feels a constant force, m
  constexpr int kHeights = 64, kHalvings = 60;
  const auto force = [&](double height) {
    return surface_->averages({Length(kProbe), Length(height), lever_.angular_drive(), harmonics_ratio_}).mean.si;
  };
  // of the lever and the sample, negative where the sample pushes the tip up
  const auto excess = [&](double height) { return k_ * (height - z) - force(height); };
  const double release = surface_->release_height().si;
  double low = release, high = release, reach = 1e-12;
  // the highest place where the sample pulls the tip down, and below it the next where it pushes it up
  for (int i = 0; i < kHeights && excess(high - kProbe) <= 0.0; ++i) high = release - (reach *= 1.2);
  if (excess(high - kProbe) <= 0.0) return std::nullopt;
  for (int i = 0; i < kHeights && excess(low) > 0.0; ++i) low = high - (reach *= 1.5);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) > 0.0 ? high : low) = middle;
  }
  const double step = 1e-5 * (release - low);
  const double stiffening = (force(low - step) - force(low + step)) / (2.0 * step * k_);
  const double spring = 1.0 - r_ * r_ + stiffening, damping = r_ / q_;
  TapState state{Length(a_ / std::hypot(spring, damping)), std::atan2(damping, spring)};
  if (!(stiffening > 0.0 && low + state.amplitude.si < release)) return std::nullopt;
  shift_ = low - z;
  shape_->straighten();
  // the contact may be no spring
  follow(state, Length(z));
  const RestingTap tap = describe(state, Length(z));
  const double deflection = low - z;
  // a free swing may have the same amplitude
  if (is_as_felt() || std::abs(tap.deflection.si - deflection) < 0.1 * std::abs(deflection)) return tap;
  averages_ = surface_->averages({state.amplitude, Length(low), lever_.angular_drive(), harmonics_ratio_});
  return RestingTap{.state = state, .deflection = Length(deflection), .averages = averages_, .stable = true};
}

std::vector<RestingTap> AveragedFlow::resting_at(Length z, Roots roots) {
  constexpr double kAtRest = 0.02;                         // imbalance allowed for a root
  constexpr double kSame = 1e-9;                           // relative difference of two roots of the same amplitude
  constexpr double kSameListed = 2e-3, kSamePhase = 0.01;  // relative difference and rad of two listed stable roots
  const std::vector<Sample> samples = samples_at(z.si, roots);
  const auto differ = [](const Sample& a, const Sample& b) { return (a.imbalance < 0.0) != (b.imbalance < 0.0); };
  std::vector<RestingTap> taps;
  // a change of sign where the shape of the swing is lost is no state, but one at the step of a latch is
  const bool latches = surface_->release_height() != surface_->contact_height();
  // a swing that is found again from a lowest height deep in the sample, without the shape that it has
  const auto found_again = [&](const RestingTap& tap) {
    return roots == Roots::Quick && std::any_of(taps.begin(), taps.end(), [&](const RestingTap& other) {
             return other.stable && tap.stable &&
                    abs(other.state.amplitude - tap.state.amplitude) < kSameListed * tap.state.amplitude &&
                    std::abs(other.state.phase - tap.state.phase) < kSamePhase;
           });
  };
  const auto add_between = [&](const Sample& one, const Sample& other) {
    const RestingTap tap = root_between(one, other, z.si);
    // without the bend its forces may not be those of a swing
    if (!has_shape_ && !is_as_felt() && abs(tap.deflection) > lever_.free_amplitude) return;
    const bool again =
        (!taps.empty() && abs(taps.back().state.amplitude - tap.state.amplitude) < kSame * tap.state.amplitude) ||
        found_again(tap);
    if (!again && (latches || std::abs(imbalance(tap.state.amplitude.si, z.si)) < kAtRest)) taps.push_back(tap);
  };
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (differ(samples[i - 1], samples[i])) {
      add_between(samples[i - 1], samples[i]);
    } else if (i + 1 < samples.size()) {
      // two roots between neighbours
      const Sample turn = turn_between(samples[i - 1], samples[i], samples[i + 1], z.si);
      if (!differ(turn, samples[i])) continue;
      add_between(samples[i - 1], turn);
      add_between(turn, samples[i + 1]);
    }
  }
  if (const auto stuck = stuck_at(z.si)) {
    const auto same = [&](const RestingTap& tap) {
      return abs(tap.state.amplitude - stuck->state.amplitude) < 0.05 * stuck->state.amplitude &&
             std::abs(tap.state.phase - stuck->state.phase) < 0.05;
    };
    if (std::none_of(taps.begin(), taps.end(), same)) taps.push_back(*stuck);
  }
  std::sort(taps.begin(), taps.end(),
            [](const RestingTap& a, const RestingTap& b) { return a.state.amplitude < b.state.amplitude; });
  return taps;
}

}  // namespace afm::physics
