// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/shared/tip_blocks.h"
#include "servo/reached_places.h"
#include "servo/servo_client.h"
#include "servo/session_file.h"

namespace afm::servo {

class LivePicture;

// True if a servo that starts at this sample computes the same forces from here on: no force is applied, and the phase
// follows from the position alone. In the tick that drops the force, the model still has the phase of the previous
// tick. `tip` is the newest state; `dynamic` means that the lever oscillates.
bool can_begin_with(const scene::TipSample& sample, const scene::TipState& tip, bool dynamic);

// Records the servo's output as sessions; a new one begins whenever a change of material, parameters, scale or settings
// has taken effect, and when a push is taken back that was made before the session began. A session begins without
// force and with the tip off the sample, contains every tick from there, and ends at a gap or at kLongestTicks, so that
// any shorter part of it can be replayed. Its particles are those for the settings in use. One thread.
class SessionRecorder {
 public:
  static constexpr std::size_t kLongestTicks = 1'800'000;  // longest session, 30 minutes at 1 kHz, about 400 MB

  // Adds everything new, in time order. True if a session begins with this sample; the previous one is then finished().
  // `picture`, if there is one, has had the sample; no session begins while it looks again.
  bool add(const scene::TipSample& sample, const ServoClient& servo, const LivePicture* picture = nullptr);
  void add(const scene::TipEvent& event);
  void add(const WallFrame& frame);

  // Call when the servo has no contact and all of its samples were added: the next sample is the first of a contact, as
  // is that of a new servo.
  void has_no_contact() { first_ = true; }

  // The file of the map that every later session of a whole map was felt on.
  void set_force_map(std::optional<RecordedForceMap> map) { force_map_ = std::move(map); }

  // Curves that were on the wall when the current session began.
  void set_earlier(std::vector<EarlierCurve> curves) { session_.earlier_curves = std::move(curves); }

  // Sources of the current session's parameters, curves::felt_sources().
  void set_sources(std::string sources) { session_.sources = std::move(sources); }

  // True once the header of the current session is known, possibly some ticks after its first sample.
  bool has_head() const { return scale_known_ && !session_.samples.empty(); }

  // Drops the records of the current session, which are stored elsewhere; recording continues.
  void forget_records();

  // Discards the current session; the next begins as soon as the force is off.
  void begin_again();

  // Ends the current session, which is then finished().
  void finish();

  const RecordedSession& session() const { return session_; }  // current session, possibly without samples
  std::optional<RecordedSession> take_finished();              // newest finished session; returned once

 private:
  bool goes_on_with(const scene::TipSample& sample) const;
  void begin(const scene::TipSample& sample, const ServoClient& servo, const LivePicture* picture);
  void take_scale(const scene::TipSample& sample, const scene::TipState& tip);

  RecordedSession session_;
  std::optional<RecordedForceMap> force_map_;
  std::optional<RecordedSession> finished_;
  std::optional<scene::TipSample> previous_;
  std::optional<scene::TipEvent> put_;  // event of particles that were put elsewhere, until its sample arrives
  ReachedPlaces places_;                // places reached in the current session
  std::size_t ticks_ = 0;               // number of ticks in the current session
  bool first_ = true;                   // true: the next sample is the first of a contact
  bool scale_known_ = false;
};

}  // namespace afm::servo
