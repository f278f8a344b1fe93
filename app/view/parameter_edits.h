// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "curves/live_parameters.h"
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

// The user's parameters for every material, and the servo's response to each change.
class ParameterEdits {
 public:
  // `loaded`: the models with which the servo was started.
  explicit ParameterEdits(std::vector<curves::SampleModel> loaded)
      : loaded_(std::move(loaded)), edits_(loaded_.size()) {}

  // Applies the button of the panel, except Close, to the parameters and to the servo. Refuses another pixel of a force
  // map while the tip touches, and otherwise takes the force away before it reads one. Returns false if it has logged
  // why it changes nothing.
  bool apply(const render::ControlTarget& target, std::size_t material, servo::ServoClient& servo);

  // Restores the loaded parameters of every material.
  void reset(servo::ServoClient& servo);

  // Sends all changes to a restarted servo.
  void resend(servo::ServoClient& servo);

  // Parameters of a material, created from the loaded ones on the first call.
  const curves::LiveParameters& of(std::size_t material);

  // The changes of a material for the other machines of a wall; empty while it is as loaded. The second function
  // applies such a record; false if it is invalid.
  std::optional<cluster::EditRecord> recorded(std::size_t material) const;
  bool follow(const cluster::EditRecord& edit);

  // Copies the parameters that the servo uses for the material under the tip into `felt`. Returns whether anything
  // changed.
  bool take_felt(const scene::TipState& tip, std::vector<curves::SampleModel>& felt);

  bool changed(std::size_t material) const;

  // State of the newest change; for the panel: Held where a pixel of a force map cannot be left.
  exhibit::ChangeState state(std::size_t material, const scene::TipState& tip) const;
  exhibit::ChangeState shown_state(std::size_t material, const scene::TipState& tip) const;

 private:
  struct Edit {
    std::optional<curves::LiveParameters> parameters;
    std::uint32_t revision = 0;  // newest edit sent to the servo; 0: none
  };
  curves::LiveParameters& parameters(std::size_t material);
  void send(std::size_t material, servo::ServoClient& servo);
  bool holds_pixel(std::size_t material, const scene::TipState& tip) const;

  std::vector<curves::SampleModel> loaded_;
  std::vector<Edit> edits_;
};

}  // namespace afm::app
