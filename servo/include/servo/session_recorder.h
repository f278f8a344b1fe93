// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "scene/shared/tip_blocks.h"
#include "servo/servo_client.h"
#include "servo/session_file.h"

namespace afm::servo {

// Whether a servo that starts at this sample feels the same from here on: no force is on, and the phase follows from
// the place alone. In the tick that drops the force the model still has the phase of the tick before. `tip` is the
// newest state; `dynamic`: the lever swings.
bool can_begin_with(const scene::TipSample& sample, const scene::TipState& tip, bool dynamic);

// Records the servo's output as sessions: a new one whenever a change of material, parameters or scale has taken
// effect. A session begins without force and with the tip off the sample, contains every tick from there, and ends at a
// gap or at kLongestTicks: any shorter part of it can be replayed. One thread.
class SessionRecorder {
 public:
  static constexpr std::size_t kLongestTicks = 1'800'000;  // 30 minutes at 1 kHz, some 400 MB

  // Everything new, in the order of its times. True: a session begins with this sample, and the one before is
  // finished().
  bool add(const scene::TipSample& sample, const ServoClient& servo);
  void add(const scene::TipEvent& event);
  void add(const WallFrame& frame);

  // The curves that were on the wall when the session under way began.
  void set_earlier(std::vector<EarlierCurve> curves) { session_.earlier_curves = std::move(curves); }

  // True once the header of the current session is known, possibly some ticks after its first sample.
  bool has_head() const { return scale_known_ && !session_.samples.empty(); }

  // The records of the session under way are kept elsewhere: it goes on without them.
  void forget_records();

  // Forgets the session under way; the next begins as soon as the force is off.
  void begin_again();

  // Ends the session under way, which is finished() then.
  void finish();

  const RecordedSession& session() const { return session_; }  // the one under way, perhaps without a sample yet
  std::optional<RecordedSession> take_finished();              // the newest that has ended; gives it once

 private:
  bool goes_on_with(const scene::TipSample& sample) const;
  void begin(const scene::TipSample& sample, const ServoClient& servo);
  void take_scale(const scene::TipSample& sample, const scene::TipState& tip);

  RecordedSession session_;
  std::optional<RecordedSession> finished_;
  std::optional<scene::TipSample> previous_;
  std::size_t ticks_ = 0;  // of the session under way
  bool scale_known_ = false;
};

}  // namespace afm::servo
