// SPDX-License-Identifier: Apache-2.0
#include "physics/manipulation/operators_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace afm::physics {
namespace {

// A place is known to a pixel: sigma_0 is the standard deviation of an even distribution over it.
Length first_doubt(const PictureFrame& frame) { return frame.pixel / std::sqrt(12.0); }

PushSetup without_scatter(PushSetup setup) {
  for (ParticleSpecies& species : setup.species) species.scatter_seed = 0;
  return setup;
}

ParticlePlace place_of(const PushedParticles& particles, std::size_t i, const Sideways<Length>& drift) {
  return {particles.position(i) + drift, particles.turn(i)};
}

// Part of a look's range of pixels around `middle` that lies within `count` pixels: first and number.
std::pair<std::size_t, std::size_t> look_range(double middle, std::size_t count) {
  constexpr double kHalf = 0.5 * static_cast<double>(kLookLines - 1);
  const double most = static_cast<double>(count);
  const double first = std::clamp(std::round(middle) - kHalf, 0.0, most);
  const double end = std::clamp(std::round(middle) + kHalf + 1.0, 0.0, most);
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(end - first)};
}

}  // namespace

OperatorsPicture::OperatorsPicture(PushSetup setup, const std::vector<PlacedParticle>& particles,
                                   const LeverBase& start, bool apart, bool looks)
    : setup_(without_scatter(std::move(setup))),
      clear_m_(clear_height(setup_).si),
      may_look_(looks),
      picture_(setup_, particles, frame_around(setup_, particles)),
      doubt_{first_doubt(frame_around(setup_, particles)), apart ? kUsualDrift : Velocity(0.0)},
      states_(particles.size()) {
  if (apart) model_.emplace(setup_, particles, start);
  for (const PlacedParticle& particle : particles) {
    species_.push_back(particle.species);
    shown_.push_back({particle.position, half_turn(particle.angle_rad)});
  }
}

void OperatorsPicture::follow(const LeverBase& base, Time elapsed, const PushedParticles& truth,
                              const Sideways<Length>& drift) {
  time_ = time_ + elapsed;
  if (model_) model_->move_to(base, elapsed);
  const bool carries =
      truth.last().state == PushState::Carried || (model_ && model_->last().state == PushState::Carried);
  if (base.z.si < clear_m_ || carries) {
    if (scan_) end_look(base);
    lifted_.reset();
    return;
  }
  if (!lifted_) {
    lifted_ = time_;
    end_stroke(truth, drift);
  }
  if (!may_look_) return;
  if (scan_) {
    scan(truth, drift);
    if (scan_->done == scan_->box.rows) end_look(base);
  } else if (time_ - *lifted_ >= kLookAfter) {
    const std::size_t particle = nearest(base);
    if (wants_look(particle)) begin_look(particle);
  }
}

void OperatorsPicture::end_stroke(const PushedParticles& truth, const Sideways<Length>& drift) {
  const std::vector<ParticlePlace> before = shown_;
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    shown_[i] = model_ ? place_of(*model_, i, {}) : place_of(truth, i, drift);
  }
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    if (shown_[i] == before[i]) continue;
    states_[i].pushed = true;
    picture_.move(i, before[i], shown_);
  }
}

std::size_t OperatorsPicture::nearest(const LeverBase& base) const {
  std::size_t best = 0;
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const double away_m = magnitude(shown_[i].position - base.position).si;
    if (!(away_m < least_m)) continue;
    least_m = away_m;
    best = i;
  }
  return best;
}

bool OperatorsPicture::is_stale(std::size_t particle) const {
  return age(particle) > doubt_.stale_after(setup_.species[species_[particle]].contact.tip_radius);
}

bool OperatorsPicture::wants_look(std::size_t particle) const {
  const State& state = states_[particle];
  // once in a lift, and again when that is stale
  if (state.pushed && state.tried <= *lifted_) return true;
  const Time since = time_ - std::max(state.seen, state.tried);
  return since > doubt_.stale_after(setup_.species[species_[particle]].contact.tip_radius);
}

double OperatorsPicture::line_m(std::size_t row) const {
  return picture_.heights().y_first_m + static_cast<double>(row) * picture_.heights().row_step_m;
}

void OperatorsPicture::begin_look(std::size_t particle) {
  const HeightGrid& grid = picture_.heights();
  const Sideways<Length>& place = shown_[particle].position;
  const auto [column, columns] = look_range((place.x.si - grid.x_first_m) / grid.column_step_m, grid.columns);
  const auto [row, rows] = look_range((place.y.si - grid.y_first_m) / grid.row_step_m, grid.rows);
  states_[particle].tried = time_;
  if (columns == 0 || rows == 0) return;
  scan_ = Scan{.particle = particle, .box = {column, row, columns, rows}, .begun = time_, .found = {}, .there = {}};
  scan_->found.resize(shown_.size());
  scan_->there = shown_;
}

// The lines that are due, from below; a particle is found in the line nearest to its middle.
void OperatorsPicture::scan(const PushedParticles& truth, const Sideways<Length>& drift) {
  Scan& scan = *scan_;
  const HeightGrid& grid = picture_.heights();
  const double left_m = grid.x_first_m + static_cast<double>(scan.box.first_column) * grid.column_step_m;
  const double right_m = left_m + static_cast<double>(scan.box.columns - 1) * grid.column_step_m;
  while (scan.done < scan.box.rows && time_ - scan.begun >= scan_time(scan.done + 1, kLookRate)) {
    const std::size_t row = scan.box.first_row + scan.done++;
    for (std::size_t i = 0; i < shown_.size(); ++i) {
      scan.there[i] = place_of(truth, i, drift);
      const double x_m = scan.there[i].position.x.si, off_m = scan.there[i].position.y.si - line_m(row);
      const bool here = x_m >= left_m && x_m <= right_m && std::abs(off_m) <= 0.5 * grid.row_step_m;
      if (here && !scan.found[i]) scan.found[i] = scan.there[i];
    }
  }
}

void OperatorsPicture::end_look(const LeverBase& base) {
  const Scan scan = std::move(*scan_);
  scan_.reset();
  if (scan.done == 0) return;
  const std::vector<ParticlePlace> before = shown_;
  SecondLook look{.at = time_,
                  .particle = scan.particle,
                  .lines = scan.done,
                  .shown = before[scan.particle],
                  .measured = scan.found[scan.particle]};
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    if (!scan.found[i]) continue;
    State& state = states_[i];
    state.found = state.found + (scan.found[i]->position - before[i].position);
    state.seen = state.tried = time_;
    state.pushed = false;
    shown_[i] = *scan.found[i];
    if (model_) model_->put(i, shown_[i]);
  }
  // a place that was left outside of the box is computed
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    if (shown_[i] != before[i]) picture_.move(i, before[i], shown_);
  }
  PixelBox measured = scan.box;
  measured.rows = scan.done;
  picture_.measure(measured, scan.there);
  if (model_) model_->hold_over({base.position, Length(std::max(base.z.si, clear_m_))});
  looks_.push_back(look);
}

bool OperatorsPicture::all_measured() const {
  return std::none_of(states_.begin(), states_.end(), [](const State& state) { return state.pushed; });
}

Sideways<Length> OperatorsPicture::found() const {
  return looks_.empty() ? Sideways<Length>{} : states_[looks_.back().particle].found;
}

}  // namespace afm::physics
