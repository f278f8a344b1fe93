// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "curves/live_parameters.h"
#include "curves/parameter_build.h"
#include "render/frame.h"

namespace afm::cluster {
struct EditRecord;
}
namespace afm::exhibit {
enum class ChangeState;
}
namespace afm::scene {
struct TipState;
}
namespace afm::servo {
class ServoClient;
}

namespace afm::app {

// The user's parameters for every material, and the servo's response to each change. No call waits for the law in
// tapping mode: a thread builds it. Main thread only.
class ParameterEdits {
 public:
  // `loaded`: the models with which the servo was started.
  explicit ParameterEdits(std::vector<curves::SampleModel> loaded)
      : loaded_(std::move(loaded)), edits_(loaded_.size()) {}

  // Applies the button of the panel, except Close, to the parameters and to the servo. Refuses another pixel of a force
  // map while the tip touches, and otherwise removes the force before it reads one. Returns false if it has logged
  // the reason for changing nothing, or if a change in tapping mode has only begun.
  bool apply(const render::ControlTarget& target, std::size_t material, servo::ServoClient& servo);

  // Call once a frame: takes the parameters that have been built, and sends them to the servo. Returns the materials
  // whose change has been made or refused.
  std::vector<std::size_t> take_built(servo::ServoClient& servo);

  // Call once a frame. True if the force must not begin: it was off after a change of the tapping lever under
  // the tip, and the servo does not have the new law yet.
  bool keeps_force_off(const scene::TipState& tip);

  // Restores the loaded parameters of every material.
  void reset(servo::ServoClient& servo);

  // Sends all changes to a restarted servo.
  void resend(servo::ServoClient& servo);

  // Parameters of a material, created from the loaded ones on the first call.
  const curves::LiveParameters& of(std::size_t material);

  // Changes of a material for the other machines of a wall; empty while it is as loaded. The second function
  // applies such a record; false if it is invalid.
  std::optional<cluster::EditRecord> recorded(std::size_t material) const;
  bool follow(const cluster::EditRecord& edit);

  // Copies the parameters that the servo uses for the material under the tip into `felt`. Returns whether anything
  // changed.
  bool take_felt(const scene::TipState& tip, std::vector<curves::SampleModel>& felt);

  bool changed(std::size_t material) const;

  // True while the law of a tapping lever is being built, here or on the machine with the hand.
  bool builds() const;
  void set_builds_elsewhere(bool builds) { builds_elsewhere_ = builds; }

  // State of the newest change; for the panel: Held if a pixel of a force map cannot be left.
  exhibit::ChangeState state(std::size_t material, const scene::TipState& tip) const;
  exhibit::ChangeState shown_state(std::size_t material, const scene::TipState& tip) const;

 private:
  struct Edit {
    std::optional<curves::LiveParameters> parameters;
    std::uint32_t revision = 0;  // newest edit sent to the servo; 0: none
    curves::ParameterBuild build{};
    bool force_off = false;  // true: no force since some frame of the newest change
  };
  curves::LiveParameters& parameters(std::size_t material);
  void send(std::size_t material, servo::ServoClient& servo);
  bool holds_pixel(std::size_t material, const scene::TipState& tip) const;

  std::vector<curves::SampleModel> loaded_;
  std::vector<Edit> edits_;
  bool builds_elsewhere_ = false;
};

}  // namespace afm::app
