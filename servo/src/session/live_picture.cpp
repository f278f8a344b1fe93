// SPDX-License-Identifier: Apache-2.0
#include "servo/live_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/check.h"
#include "haptics/felt_particles.h"
#include "haptics/particle_push.h"
#include "physics/manipulation/operators_picture.h"
#include "physics/manipulation/particle_picture.h"
#include "physics/manipulation/push_figures.h"
#include "physics/quantity_text.h"
#include "scene/shared/push_values.h"

namespace afm::servo {

namespace {

using physics::Length;
using scene::ParticlePage;
using scene::ParticlePose;

constexpr std::int64_t kLineNs = 100'000'000;  // time of a line at OperatorsPicture::kLookRate
static_assert(static_cast<double>(kLineNs) * physics::OperatorsPicture::kLookRate.si == 1e9);
constexpr double kLookReach = 3.0;  // half size of a look's square, in footprint radii
constexpr double kHalfLines = 0.5 * static_cast<double>(physics::kLookLines - 1);

const ParticlePose& pose_in(const std::vector<ParticlePage>& pages, std::size_t particle) {
  return pages[particle / scene::kPosesPerPage].poses[particle % scene::kPosesPerPage];
}

ParticlePose& pose_in(std::vector<ParticlePage>& pages, std::size_t particle) {
  return pages[particle / scene::kPosesPerPage].poses[particle % scene::kPosesPerPage];
}

ParticlePose moved(ParticlePose pose, const glm::dvec2& way_m) {
  pose.x_m += way_m.x;
  pose.y_m += way_m.y;
  return pose;
}

glm::dvec2 place_of(const ParticlePose& pose) { return {pose.x_m, pose.y_m}; }

bool same_place(const ParticlePose& a, const ParticlePose& b) {
  return a.x_m == b.x_m && a.y_m == b.y_m && scene::turn_of(a) == scene::turn_of(b);
}

// The particles as a person knows them: on a sample that rests, without scatter.
std::unique_ptr<scene::SharedParticles> known_set(const scene::SharedParticles& set) {
  auto known = std::make_unique<scene::SharedParticles>(set);
  known->level = {.level = 1};  // level without drift and with looks
  for (scene::SharedSpecies& species : known->species) species.scatter_seed = 0;
  return known;
}

bool fits(const PictureState& state, const scene::SharedParticles& set) {
  const std::size_t pages = scene::pages_of(set.count);
  return state.seen_ns.size() == set.count && state.shown.size() == pages && state.measured.size() == pages;
}

}  // namespace

// Lines at a distance of `line_m` from below, around `middle_m`.
struct LivePicture::Look {
  std::size_t particle = 0;
  LookSquare square;
  std::int64_t begun_ns = 0;
  std::size_t done = 0;  // number of finished lines
  double load_n = 0;     // load of a scan that presses too hard to climb every particle; 0: none
  std::vector<ParticlePage>
      truth;  // particles on the sample, which rest while the tip is off them; empty: not yet known
  std::vector<std::optional<ParticlePose>> found{};  // place found for each particle

  double line_m() const { return square.half_m / kHalfLines; }
  std::int64_t end_of_line(std::size_t line) const { return begun_ns + static_cast<std::int64_t>(line + 1) * kLineNs; }
};

core::Result<std::unique_ptr<LivePicture>> LivePicture::create(const scene::SharedParticles& set,
                                                               const scene::SharedDevice& device, PictureState start) {
  const auto scale = haptics::particle_scale(set, haptics::spec_of(device));
  if (!scale) return tl::unexpected(scale.error());
  if (!start.empty() && !fits(start, set)) {
    return core::failure(core::ErrorCategory::BadInputFile, "its picture is one of other particles");
  }
  auto model = std::make_unique<haptics::FeltParticles>(*known_set(set), *scale);
  std::vector<ParticlePage> first(model->pages().begin(), model->pages().end());
  try {
    if (!start.empty()) model->resume(start.shown);
  } catch (const std::invalid_argument& error) {
    return core::failure(core::ErrorCategory::BadInputFile, fmt::format("its picture: {}", error.what()));
  }
  return std::unique_ptr<LivePicture>(
      new LivePicture(set, scale->clear_z_m, std::move(first), std::move(model), std::move(start)));
}

LivePicture::LivePicture(const scene::SharedParticles& set, double clear_z_m, std::vector<ParticlePage> first,
                         std::unique_ptr<haptics::FeltParticles> model, PictureState start)
    : count_(set.count),
      level_(set.level.level),
      clear_z_m_(clear_z_m),
      drift_(set.level.level > 1 ? physics::kUsualDrift : physics::Velocity(0.0), set.level.seed),
      start_(std::move(first)),
      state_(std::move(start)),
      since_ns_(set.level.since_ns) {
  const physics::PushSetup setup = scene::push_setup(set);
  double widest_m = 0.0;
  for (std::uint32_t i = 0; i < set.count; ++i) {
    const physics::ParticleSpecies& species = setup.species[set.particles[i].species];
    const double gentle_n = physics::climbing_load(species, setup.tip, setup.tip_friction).si;
    gentle_n_.push_back(set.particles[i].pinned != 0 ? std::numeric_limits<double>::infinity() : gentle_n);
    const Length radius = species.contact.tip_radius;
    reach_m_.push_back(physics::footprint_radius(setup.tip, radius).si);
    widest_m = std::max(widest_m, reach_m_.back());
  }
  const Length pixel(kLookReach * widest_m / kHalfLines);
  for (std::uint32_t i = 0; i < set.count; ++i) {
    doubts_.push_back(
        {.at_first = pixel / std::sqrt(12.0), .rate = level_ > 1 ? physics::kUsualDrift : physics::Velocity(0.0)});
    const Length radius = setup.species[set.particles[i].species].contact.tip_radius;
    // without drift the doubt stays what a look leaves
    stale_after_.push_back(level_ > 1 ? doubts_.back().stale_after(radius)
                                      : physics::Time(std::numeric_limits<double>::infinity()));
  }
  if (level_ > 1) model_ = std::move(model);
  now_.level = level_;
  now_.known.assign(count_, Known::Measured);
}

LivePicture::~LivePicture() = default;

glm::dvec2 LivePicture::drift_m(std::int64_t time_ns) const {
  const double elapsed_s = 1e-9 * static_cast<double>(std::max<std::int64_t>(0, time_ns - since_ns_));
  const auto way = drift_.after(physics::Time(elapsed_s));
  return {way.x.si, way.y.si};
}

void LivePicture::add(const scene::TipEvent& event) {
  if (event.kind == physics::EventKind::LookedAgain) ordered_ = true;
  if (event.kind == physics::EventKind::ParticlesPutBack) put_back_ = true;
}

void LivePicture::add(const scene::TipSample& sample, std::span<const ParticlePage> truth) {
  const bool first = time_ns_ == 0;
  const double elapsed_s = first ? 0.0 : 1e-9 * static_cast<double>(sample.time_ns - time_ns_);
  time_ns_ = sample.time_ns;
  since_ns_ = sample.level.since_ns;
  lifted_ = sample.level.met == 0 || sample.tip.z_m >= clear_z_m_;
  if (put_back_) {
    look_.reset();
    measure_all(start_);
  } else if (state_.empty()) {
    if (!holds(truth, sample.push.digest)) return;
    measure_all(truth);
  }
  if (look_ && !lifted_) end_look();
  tip_m_ = {sample.surface.xy_m[0], sample.surface.xy_m[1]};
  tip_z_m_ = sample.tip.z_m;
  if (model_ && sample.level.met == 0) model_->lift();
  if (model_ && sample.level.met != 0) model_->step(tip_m_, tip_z_m_, elapsed_s);
  follow_scan(sample.scan, elapsed_s);
  show_computed(truth);
  if (ordered_ && lifted_) begin_look();
  ordered_ = put_back_ = false;
  if (look_) scan(sample.push.digest, truth);
  figure();
}

// Measures the places of all particles as a scan of all of them would find them.
void LivePicture::measure_all(std::span<const ParticlePage> truth) {
  const glm::dvec2 way_m = drift_m(time_ns_);
  state_.shown.assign(truth.begin(), truth.end());
  state_.shown.resize(scene::pages_of(static_cast<std::uint32_t>(count_)));
  for (std::size_t i = 0; i < count_; ++i) pose_in(state_.shown, i) = moved(pose_in(state_.shown, i), way_m);
  state_.measured = state_.shown;
  state_.seen_ns.assign(count_, time_ns_);
  if (model_) model_->resume(state_.shown);
}

// Follows a scan that presses harder than is gentle.
void LivePicture::follow_scan(const scene::ScanLead& scan, double elapsed_s) {
  if (look_ && scan.hand == scene::ScanHand::Looks) look_->load_n = 1e-12 * scan.load_pn;
  haptics::ParticlePush push;
  if (model_) model_->sweep(scan, elapsed_s, push);
}

void LivePicture::show_computed(std::span<const ParticlePage> truth) {
  const std::span<const ParticlePage> computed = model_ ? model_->pages() : truth;
  if (computed.size() == state_.shown.size()) std::copy(computed.begin(), computed.end(), state_.shown.begin());
}

std::size_t LivePicture::nearest() const {
  std::size_t best = 0;
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count_; ++i) {
    const double away_m = glm::distance(place_of(pose_in(state_.shown, i)), tip_m_);
    if (!(away_m < least_m)) continue;
    least_m = away_m;
    best = i;
  }
  return best;
}

std::optional<LookSquare> LivePicture::square() const { return look_ ? std::optional(look_->square) : std::nullopt; }

// A new order begins a new look.
void LivePicture::begin_look() {
  const std::size_t particle = nearest();
  look_ = std::make_unique<Look>(
      Look{.particle = particle,
           .square = {.middle_m = place_of(pose_in(state_.shown, particle)), .half_m = kLookReach * reach_m_[particle]},
           .begun_ns = time_ns_,
           .truth = {},
           .found = std::vector<std::optional<ParticlePose>>(count_)});
}

// True if the servo's pages belong to the sample; they may be older or newer.
bool LivePicture::holds(std::span<const ParticlePage> truth, std::uint64_t digest) const {
  return truth.size() == start_.size() && scene::digest_of(truth, count_) == digest;
}

// Scans the lines that are due, from below. During a look no particle moves on the sample.
void LivePicture::scan(std::uint64_t digest, std::span<const ParticlePage> truth) {
  if (look_->truth.empty() && holds(truth, digest)) {
    look_->truth.assign(truth.begin(), truth.end());
  }
  if (look_->truth.empty()) return;
  while (look_->done < physics::kLookLines && look_->end_of_line(look_->done) <= time_ns_) read_line();
  if (look_->done == physics::kLookLines) end_look();
}

// Reads one line. A particle is found in the line nearest to its middle, at its place at that moment.
void LivePicture::read_line() {
  Look& look = *look_;
  const glm::dvec2 way_m = drift_m(look.end_of_line(look.done));
  const double y_m = look.square.middle_m.y - look.square.half_m + static_cast<double>(look.done) * look.line_m();
  for (std::size_t i = 0; i < count_; ++i) {
    const ParticlePose there = moved(pose_in(look.truth, i), way_m);
    const bool here = std::abs(there.x_m - look.square.middle_m.x) <= look.square.half_m &&
                      std::abs(there.y_m - y_m) <= 0.5 * look.line_m();
    if (here && !look.found[i]) look.found[i] = there;
  }
  ++look.done;
}

void LivePicture::end_look() {
  const std::unique_ptr<const Look> look = std::move(look_);
  if (look->done == 0) return;
  now_.newest = {.particle = look->particle, .lines = look->done, .off_m = std::nullopt};
  const auto swept = [&](std::size_t i) { return look->load_n > gentle_n_[i]; };
  if (swept(look->particle)) now_.newest.swept_above_n = gentle_n_[look->particle];
  ++now_.looks;
  for (std::size_t i = 0; i < count_; ++i) {
    if (!look->found[i] || swept(i)) continue;
    if (i == look->particle) {
      now_.newest.off_m = glm::distance(place_of(*look->found[i]), place_of(pose_in(state_.shown, i)));
    }
    pose_in(state_.shown, i) = pose_in(state_.measured, i) = *look->found[i];
    state_.seen_ns[i] = time_ns_;
  }
  if (!model_) return;
  model_->resume(state_.shown);
  // over them as before, so that it meets them with the servo's
  if (tip_z_m_ >= clear_z_m_) model_->step(tip_m_, tip_z_m_, 0.0);
}

void LivePicture::figure() {
  const auto age_of = [&](std::size_t i) {
    return physics::Time(1e-9 * static_cast<double>(time_ns_ - state_.seen_ns[i]));
  };
  now_.all_measured = true;
  for (std::size_t i = 0; i < count_; ++i) {
    const bool measured = same_place(pose_in(state_.shown, i), pose_in(state_.measured, i));
    now_.all_measured = now_.all_measured && measured;
    now_.known[i] = age_of(i) > stale_after_[i] ? Known::Stale : measured ? Known::Measured : Known::Computed;
  }
  now_.particle = look_ ? look_->particle : nearest();
  now_.age_s = age_of(now_.particle).si;
  now_.doubt_m = doubts_[now_.particle].after(age_of(now_.particle)).si;
  now_.look_share.reset();
  if (look_) now_.look_share = static_cast<double>(look_->done) / static_cast<double>(physics::kLookLines);
}

void follow_settings(std::unique_ptr<LivePicture>& picture, const scene::SharedParticles& set,
                     const scene::SharedDevice& device, const scene::PushSettings& settings) {
  if (picture && picture->settings_ == settings) return;
  const std::uint32_t level = settings.level > 0 ? settings.level - 1U : set.level.level;
  if (level == 0) return picture.reset();
  const auto adjusted = std::make_unique<scene::SharedParticles>(set);
  scene::adjust(settings, *adjusted);
  auto made =
      LivePicture::create(*adjusted, device, picture && picture->level_ == level ? picture->state_ : PictureState{});
  AFM_CHECK(made);  // always true, because the servo has built the same particles for this device
  picture = std::move(*made);
  picture->settings_ = settings;
}

std::string text_of(const LookResult& look) {
  const std::string lines = look.lines < physics::kLookLines ? fmt::format(" (only {} of {} lines: the tip came down)",
                                                                           look.lines, physics::kLookLines)
                                                             : "";
  if (look.swept_above_n > 0.0) {
    return fmt::format(
        "looked again: the scan pushed particle {} away, because its load is above the gentle one of {}{}",
        look.particle + 1, physics::format_quantity(physics::Force(look.swept_above_n), physics::kForceUnits, 3),
        lines);
  }
  if (!look.off_m) return fmt::format("looked again: particle {} was not found{}", look.particle + 1, lines);
  return fmt::format("looked again: particle {} lies {:.2f} nm from where the picture had it{}", look.particle + 1,
                     1e9 * *look.off_m, lines);
}

}  // namespace afm::servo
