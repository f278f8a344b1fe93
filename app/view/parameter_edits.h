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
  // As the servo was started with.
  explicit ParameterEdits(std::vector<curves::SampleModel> loaded)
      : loaded_(std::move(loaded)), edits_(loaded_.size()) {}

  // Applies the button of the panel, except Close, to the parameters and to the servo.
  void apply(const render::ControlTarget& target, std::size_t material, servo::ServoClient& servo);

  // Restores the loaded parameters of every material.
  void reset(servo::ServoClient& servo);

  // Sends all changes to a restarted servo.
  void resend(servo::ServoClient& servo);

  // Of a material that has been asked for before; made from what was loaded if it has not.
  const curves::LiveParameters& of(std::size_t material);

  // All that a person has set of a material, for other machines of the wall; nothing as long as it is as loaded. And
  // the same there; false: it cannot be.
  std::optional<cluster::EditRecord> recorded(std::size_t material) const;
  bool follow(const cluster::EditRecord& edit);

  // What the servo has taken of the material under the tip becomes what is felt. Whether anything changed.
  bool take_felt(const scene::TipState& tip, std::vector<curves::SampleModel>& felt);

  bool changed(std::size_t material) const;
  exhibit::ChangeState state(std::size_t material, const scene::TipState& tip) const;

 private:
  struct Edit {
    std::optional<curves::LiveParameters> parameters;
    std::uint32_t revision = 0;  // of the newest edit that was sent to the servo, 0: none
  };
  curves::LiveParameters& parameters(std::size_t material);

  std::vector<curves::SampleModel> loaded_;
  std::vector<Edit> edits_;
};

}  // namespace afm::app
