// SPDX-License-Identifier: Apache-2.0
#include "instrument/simulated_instrument.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "curves/tapping/driven_setup.h"
#include "fits/thermal_fit.h"
#include "instrument/showcase.h"
#include "physics/flexural_modes.h"
#include "physics/imaging/scan_artefact.h"
#include "physics/tapping/driven_lever.h"
#include "physics/thermal_noise.h"
#include "physics/units.h"

namespace afm::instrument {
namespace {

using core::wrong_usage;

constexpr double kStartAboveM = 1e-6;       // height of the tip above the sample at the start
constexpr double kGrowthThatIsSeen = 0.02;  // relative growth of the tip from which the image's surface is recomputed

// Strongest push of a pass; in tapping mode at the lowest points of the swing.
double push_of(const physics::ScanTrack& pass, bool taps) {
  if (!taps) return pass.highest_force_n;
  return *std::max_element(pass.peak_force_n.begin(), pass.peak_force_n.end());
}

// Changes of state along both passes.
std::size_t flips_of(const physics::ScanLine& line, const physics::TappingDetector& detector) {
  const double free_deg = detector.lever().free_phase * 180.0 / std::numbers::pi;
  return physics::changes_of_state(line.trace.phase_deg, free_deg) +
         physics::changes_of_state(line.retrace.phase_deg, free_deg);
}

// The contact whose tip has grown by wear.
core::Result<curves::ContactSetup> worn_contact(curves::ContactOptions options, double growth_m) {
  auto setup = contact_of(options);
  if (!setup || growth_m <= 0.0) return setup;
  options.si_values["tip-radius"] = setup->material.contact.tip_radius.si + growth_m;
  return contact_of(options);
}

std::string metres(const std::optional<double>& si) { return si ? fmt::format("{} m", *si) : std::string(); }

}  // namespace

SimulatedInstrument::SimulatedInstrument(std::string assets_dir, imaging::OwnSample sample)
    : assets_dir_(std::move(assets_dir)), sample_(std::move(sample)), noise_(0) {}

core::Result<SimulatedInstrument> SimulatedInstrument::create(std::string assets_dir, std::uint64_t seed,
                                                              imaging::OwnSample sample) {
  SimulatedInstrument made(std::move(assets_dir), std::move(sample));
  if (const auto ready = made.reset(seed); !ready) return tl::unexpected(ready.error());
  return made;
}

void SimulatedInstrument::show_in(Showcase& showcase) {
  showcase_ = &showcase;
  showcase.put_contact(setup_);
  show_place();
}

void SimulatedInstrument::show_place() const {
  if (showcase_ == nullptr) return;
  const double surface_m = surface_below();
  showcase_->put_place(at_.x_m - drift_x_m_, at_.y_m - drift_y_m_, surface_m, at_.z_m - surface_m, force_n(),
                       touching_);
}

core::Result<void> SimulatedInstrument::reset(std::uint64_t seed) {
  InstrumentSettings settings;
  settings.contact.assets_dir = assets_dir_;
  settings.contact.material = "mica";
  if (growth_m_ > 0.0) surface_radius_m_ = 0.0;  // drops the surface of the worn tip
  at_ = {.z_m = kStartAboveM};
  touching_ = second_apex_ = false;
  if (const auto built = build(settings, 0.0); !built) return built;
  growth_m_ = drift_x_m_ = drift_y_m_ = highest_force_n_ = 0.0;
  state_flips_ = 0;
  chance_.seed(seed);
  noise_ = physics::NormalGenerator(seed);
  show_place();
  return {};
}

core::Result<void> SimulatedInstrument::change(const InstrumentSettings& settings) {
  physics::ScanSettings scan(settings.scan);
  try {
    physics::validate(scan);
  } catch (const physics::UnphysicalValue& error) {
    return wrong_usage(error.what());
  }
  return build(settings, growth_m_);
}

// Builds everything that follows from settings and the worn tip; on failure nothing has changed.
core::Result<void> SimulatedInstrument::build(const InstrumentSettings& settings, double growth_m) {
  const bool same_contact = surface_ != nullptr && settings.contact.material == settings_.contact.material &&
                            settings.contact.model == settings_.contact.model &&
                            settings.contact.si_values == settings_.contact.si_values;
  const bool same_setup = same_contact && growth_m == growth_m_;
  auto setup = same_setup ? core::Result<curves::ContactSetup>(setup_) : worn_contact(settings.contact, growth_m);
  if (!setup) return tl::unexpected(setup.error());
  const double radius_m = setup->material.contact.tip_radius.si;
  const bool same = same_contact && settings.tip.kind == settings_.tip.kind &&
                    settings.tip.half_angle_rad == settings_.tip.half_angle_rad;
  if (!same || std::abs(radius_m - surface_radius_m_) > kGrowthThatIsSeen * surface_radius_m_) {
    physics::TipShape tip(settings.tip);
    tip.radius = physics::Length(radius_m);
    auto surface = imaging::scan_surface(*setup, tip, assets_dir_, sample_);
    if (!surface) return tl::unexpected(surface.error());
    surface_ = std::make_shared<const imaging::ScanSurface>(std::move(*surface));
    surface_radius_m_ = radius_m;
  }
  settings_ = settings;
  setup_ = std::move(*setup);
  if (!same_setup) usual_path_.reset();
  base_.reset();
  growth_m_ = growth_m;
  if (!at_.engaged && touching_) follow_base();
  if (showcase_ != nullptr) showcase_->put_contact(setup_);
  show_place();
  return {};
}

physics::ScanSettings SimulatedInstrument::scan_settings() const {
  physics::ScanSettings scan(settings_.scan);
  scan.spring_constant = setup_.material.contact.spring_constant;
  scan.adhesion = physics::Force(surface_->pull_off_force_n);
  scan.snap_in = physics::Length(surface_->snap_in_m);
  scan.second_apex_distance = physics::Length(second_apex_ ? settings_.faults.second_apex_m : 0.0);
  return scan;
}

// The surface as the scanner sees it from now on: displaced by the drift so far; for a tip that engaged falsely,
// nothing.
physics::Scanner::Surface SimulatedInstrument::surface_now() const {
  if (!touching_) return [z_m = at_.z_m](double, double) { return z_m; };
  if (settings_.flat) return [](double, double) { return 0.0; };
  const double cosine = std::cos(settings_.turn_rad), sine = std::sin(settings_.turn_rad);
  return [surface = surface_, drift_x = drift_x_m_, drift_y = drift_y_m_, middle_x = at_.x_m, middle_y = at_.y_m,
          cosine, sine](double x_m, double y_m) {
    const double x = x_m - middle_x, y = y_m - middle_y;
    return surface->height_m(middle_x + cosine * x - sine * y - drift_x, middle_y + sine * x + cosine * y - drift_y);
  };
}

double SimulatedInstrument::surface_below() const {
  return settings_.flat ? 0.0 : surface_->height_m(at_.x_m - drift_x_m_, at_.y_m - drift_y_m_);
}

// Random number from 0 to below 1, the same on every machine.
double SimulatedInstrument::uniform() { return static_cast<double>(chance_() >> 11) * 0x1p-53; }

void SimulatedInstrument::pass(double time_s) noexcept {
  at_.time_s += time_s;
  drift_x_m_ += time_s * settings_.scan.drift_x.si;
  drift_y_m_ += time_s * settings_.scan.drift_y.si;
}

core::Result<void> SimulatedInstrument::wear(double force_n) {
  highest_force_n_ = std::max(highest_force_n_, force_n);
  const Faults& faults = settings_.faults;
  if (faults.blunting_force_n <= 0.0 || force_n <= faults.blunting_force_n) return {};
  const auto worn = build(settings_, growth_m_ + faults.blunting_m_per_n * (force_n - faults.blunting_force_n));
  if (!worn) return wrong_usage("the tip would wear too much: " + worn.error().message);
  return {};
}

void SimulatedInstrument::take_back_to(SimulatedInstrument before) {
  *this = std::move(before);
  if (showcase_ != nullptr) showcase_->put_contact(setup_);
  show_place();
}

curves::PathOptions SimulatedInstrument::path_of(const std::optional<double>& from,
                                                 const std::optional<double>& to) const {
  return {.from = metres(from), .to = metres(to)};
}

core::Result<SimulatedInstrument::Curve> SimulatedInstrument::curve(const CurveRequest& request) {
  SimulatedInstrument before(*this);
  auto curve = take_curve(request);
  if (!curve) take_back_to(std::move(before));
  return curve;
}

core::Result<SimulatedInstrument::Curve> SimulatedInstrument::take_curve(const CurveRequest& request) {
  curves::PathOptions path = path_of(request.z_from_m, request.z_to_m);
  if (!request.z_from_m || !request.z_to_m) {
    if (!usual_path_) {
      const auto usual = curves::run_curve(setup_, {.events_only = true});
      if (!usual) return tl::unexpected(usual.error());
      usual_path_ = usual->plan;
    }
    path = path_of(request.z_from_m.value_or(usual_path_->from.si), request.z_to_m.value_or(usual_path_->to.si));
  }
  const auto from = physics::parse_quantity(path.from, physics::kLengthUnits).value;
  const auto to = physics::parse_quantity(path.to, physics::kLengthUnits).value;
  if (!from || !to || !(*from > *to)) {
    return wrong_usage(fmt::format("the curve would go from {} to {}: begin above its end", path.from, path.to));
  }
  const double length_m = (*from - *to).si;
  path.step = metres(length_m / static_cast<double>(request.points - 1) * (1.0 + 1e-12));
  if (setup_.model.dynamic) {
    path.speed = fmt::format("{} m/s", request.speed_m_per_s);
    path.seed = std::to_string(chance_());
  }
  auto run = curves::run_curve(setup_, path);
  if (!run) return tl::unexpected(run.error());
  Curve result{std::move(*run), {}};
  double highest_n = 0.0;
  result.shown_n.reserve(result.run.curve.samples.size());
  for (const physics::CurveSample& sample : result.run.curve.samples) {
    highest_n = std::max(highest_n, sample.force.si);
    result.shown_n.push_back(shown(sample.force.si));
  }
  pass(2.0 * length_m / request.speed_m_per_s);
  if (const auto worn = wear(highest_n); !worn) return tl::unexpected(worn.error());
  if (showcase_ != nullptr) showcase_->put_curve(result.run.curve);
  return result;
}

core::Result<SimulatedInstrument::Driven> SimulatedInstrument::driven() const {
  curves::TappingChoice choice;
  choice.mode = "tapping";
  choice.numbers.free_amplitude = metres(settings_.free_amplitude_m);
  if (settings_.drive_hz > 0.0) choice.numbers.drive = fmt::format("{} Hz", settings_.drive_hz);
  if (settings_.viscosity_pa_s > 0.0) choice.numbers.viscosity = fmt::format("{} Pa*s", settings_.viscosity_pa_s);
  curves::ContactOptions options(settings_.contact);
  if (growth_m_ > 0.0) options.si_values["tip-radius"] = setup_.material.contact.tip_radius.si;
  auto setup = curves::driven_setup(choice, options);
  if (!setup) return tl::unexpected(setup.error());
  return Driven{choice.numbers, std::move(*setup)};
}

core::Result<std::optional<physics::TappingDetector>> SimulatedInstrument::detector() const {
  if (!settings_.taps) return std::nullopt;
  const auto swung = driven();
  if (!swung) return tl::unexpected(swung.error());
  const auto sample = curves::driven_sample(swung->setup, swung->numbers);
  if (!sample) return tl::unexpected(sample.error());
  try {
    return physics::TappingDetector(sample->surface, sample->lever,
                                    settings_.amplitude_setpoint * sample->lever.free_amplitude);
  } catch (const physics::UnphysicalValue& error) {
    return wrong_usage(error.what());
  }
}

core::Result<curves::TappingRun> SimulatedInstrument::tapping_curve(const std::optional<double>& z_from_m,
                                                                    const std::optional<double>& z_to_m,
                                                                    std::size_t points, const curves::TapWatch& watch) {
  const auto swung = driven();
  if (!swung) return tl::unexpected(swung.error());
  const curves::UsualTapPath usual = curves::usual_tap_path(physics::Length(settings_.free_amplitude_m));
  const double from_m = z_from_m.value_or(usual.from.si), to_m = z_to_m.value_or(usual.to.si);
  curves::PathOptions path = path_of(from_m, to_m);
  if (from_m > to_m) path.step = metres((from_m - to_m) / static_cast<double>(points - 1) * (1.0 + 1e-12));
  return curves::run_tapping(swung->setup, path, swung->numbers, watch);
}

core::Result<void> SimulatedInstrument::after_line(const physics::ScanLine& line, physics::Scanner& scanner) {
  const double grown_m = growth_m_, surface_radius_m = surface_radius_m_;
  const bool had_second = second_apex_;
  if (const auto worn = wear(std::max(push_of(line.trace, settings_.taps), push_of(line.retrace, settings_.taps)));
      !worn) {
    return tl::unexpected(worn.error());
  }
  if (uniform() < settings_.faults.tip_change) second_apex_ = !second_apex_;
  if (second_apex_ != had_second || growth_m_ != grown_m) scanner.change(scan_settings());
  if (surface_radius_m_ != surface_radius_m) scanner.change_surface(surface_now());
  return {};
}

SimulatedInstrument::Frame SimulatedInstrument::frame() const {
  const double width_m = settings_.size_m > 0.0 ? settings_.size_m : std::min(surface_->width_m, surface_->depth_m);
  const double square_m = width_m / static_cast<double>(settings_.pixels);
  return {width_m,
          settings_.height_m > 0.0 ? settings_.height_m : square_m * static_cast<double>(settings_.lines_or_pixels())};
}

core::Result<physics::ScanImage> SimulatedInstrument::scan(const TakeLine& taken) {
  SimulatedInstrument before(*this);
  auto image = take_image(taken);
  if (!image) take_back_to(std::move(before));
  return image;
}

core::Result<physics::ScanImage> SimulatedInstrument::take_image(const TakeLine& taken) {
  if (!at_.engaged) return wrong_usage("the feedback does not hold the tip; approach the sample first");
  const Frame size = frame();
  physics::ScanArea area;
  area.width = physics::Length(size.width_m);
  area.height = physics::Length(size.height_m);
  area.x_centre = physics::Length(at_.x_m);
  area.y_centre = physics::Length(at_.y_m);
  area.columns = settings_.pixels;
  area.rows = settings_.lines_or_pixels();
  try {
    const auto swing = detector();
    if (!swing) return tl::unexpected(swing.error());
    physics::Scanner scanner(area, scan_settings(), surface_now(), chance_(), *swing);
    scanner.begin_frame(settings_.upwards ? physics::SlowDirection::Up : physics::SlowDirection::Down);
    if (showcase_ != nullptr) showcase_->begin_image(area, settings_.scan.line_rate.si, settings_.turn_rad);
    std::optional<core::Error> error;
    state_flips_ = 0;
    physics::ScanImage image = physics::scan_frame(scanner, [&](const physics::ScanLine& line) {
      physics::ScanLine shown(line);
      if (*swing) {
        state_flips_ += flips_of(line, **swing);
        for (auto* pass : {&shown.trace, &shown.retrace}) std::fill(pass->error_n.begin(), pass->error_n.end(), 0.0);
      }
      if (showcase_ != nullptr) showcase_->put_line(shown);  // not in tapping mode, where the error is an amplitude
      const auto worn = after_line(line, scanner);
      if (!worn) error = worn.error();
      return !error && taken(line, at_.time_s + scanner.time().si);
    });
    pass(scanner.time().si);
    if (showcase_ != nullptr) showcase_->end_image();
    if (error) return tl::unexpected(*error);
    return image;
  } catch (const physics::UnphysicalValue& error) {
    return wrong_usage(error.what());
  }
}

std::vector<fits::SpectrumPoint> SimulatedInstrument::thermal(std::size_t points, double most_hz,
                                                              std::size_t averages) {
  const physics::LeverDynamics& lever = setup_.material.lever;
  const double rms_m = physics::thermal_deflection(setup_.material.contact.spring_constant, lever.temperature).si;
  const fits::Oscillator mode{.resonance_hz = lever.resonance.si,
                              .quality_factor = lever.quality_factor,
                              .area = rms_m * rms_m * physics::virtual_thermal_share(1),
                              .floor = 0.0};
  std::vector<fits::SpectrumPoint> spectrum;
  for (std::size_t i = 1; i <= points; ++i) {
    const double frequency_hz = most_hz * static_cast<double>(i) / static_cast<double>(points);
    double sum = 0.0;
    for (std::size_t k = 0; k < averages; ++k) sum -= std::log(1.0 - uniform());
    spectrum.push_back({frequency_hz, fits::density_at(mode, frequency_hz) * sum / static_cast<double>(averages)});
  }
  // a periodogram takes one over the distance of its frequencies
  pass(static_cast<double>(averages * points) / most_hz);
  return spectrum;
}

SimulatedInstrument::Truth SimulatedInstrument::truth() const {
  return {.tip_radius_m = setup_.material.contact.tip_radius.si,
          .tip_growth_m = growth_m_,
          .touching = touching_,
          .second_apex = second_apex_,
          .surface_m = surface_below(),
          .sample_x_m = drift_x_m_,
          .sample_y_m = drift_y_m_,
          .highest_force_n = highest_force_n_,
          .state_flips = state_flips_};
}

}  // namespace afm::instrument
