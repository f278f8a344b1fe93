// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "physics/manipulation/particle_picture.h"
#include "physics/manipulation/pushed_particles.h"
#include "physics/manipulation/sample_drift.h"
#include "physics/units.h"

namespace afm::physics {

// Result of a second look.
struct SecondLook {
  Time at;                   // end of the scan, since the start
  std::size_t particle = 0;  // particle that was scanned again, and number of lines scanned
  std::size_t lines = 0;
  ParticlePlace shown;                    // place in the picture before the scan
  std::optional<ParticlePlace> measured;  // place found by the scan; empty if the particle is not in the box
};

// Picture in the scanner's frame that a person has of particles and pushes by: measured once, computed after each
// stroke, and measured again where the person looks (docs/manipulation.md). A look begins when the hand has been lifted
// for kLookAfter over a particle that is not measured, or stale, and ends when the hand comes down. One thread;
// allocates.
class OperatorsPicture {
 public:
  static constexpr Time kLookAfter{2.0};
  static constexpr Frequency kLookRate{10.0};  // lines per second

  // With `apart`, the picture is computed by a model without drift and without scatter of pull-offs; otherwise it is
  // computed from where the particles are. Without `looks` nobody looks again. Throws as PushedParticles does.
  OperatorsPicture(PushSetup setup, const std::vector<PlacedParticle>& particles, const LeverBase& start, bool apart,
                   bool looks);

  // Call after each tick: `base` is in the frame of the picture, and the sample of `truth` has drifted by `drift`.
  void follow(const LeverBase& base, Time elapsed, const PushedParticles& truth, const Sideways<Length>& drift);

  const ParticlePicture& picture() const { return picture_; }
  std::span<const ParticlePlace> shown() const { return shown_; }
  const PlaceDoubt& doubt() const { return doubt_; }
  std::span<const SecondLook> looks() const { return looks_; }

  bool is_measured(std::size_t particle) const { return !states_[particle].pushed; }  // scanned since its last push
  bool all_measured() const;
  Time age(std::size_t particle) const { return time_ - states_[particle].seen; }  // time since the last scan of it
  bool is_stale(std::size_t particle) const;

  // Sum of the results of all looks at the newest look's particle: a hand aims that far beside its first plan.
  Sideways<Length> found() const;

 private:
  struct State {
    Time seen, tried;  // times of the last successful and the last attempted scan
    bool pushed = false;
    Sideways<Length> found;
  };
  struct Scan {
    std::size_t particle = 0;
    PixelBox box;
    Time begun;
    std::size_t done = 0;  // number of finished lines
    std::vector<std::optional<ParticlePlace>> found;
    std::vector<ParticlePlace> there;  // places of the particles during the newest line
  };

  void end_stroke(const PushedParticles& truth, const Sideways<Length>& drift);
  std::size_t nearest(const LeverBase& base) const;
  bool wants_look(std::size_t particle) const;
  void begin_look(std::size_t particle);
  void scan(const PushedParticles& truth, const Sideways<Length>& drift);
  void end_look(const LeverBase& base);
  double line_m(std::size_t row) const;

  PushSetup setup_;
  double clear_m_;
  bool may_look_;
  ParticlePicture picture_;
  PlaceDoubt doubt_;
  std::optional<PushedParticles> model_;  // model of the computed picture; empty unless it differs from the truth
  std::vector<std::size_t> species_;
  std::vector<ParticlePlace> shown_;
  std::vector<State> states_;
  std::vector<SecondLook> looks_;
  Time time_;
  std::optional<Time> lifted_;
  std::optional<Scan> scan_;
};

}  // namespace afm::physics
