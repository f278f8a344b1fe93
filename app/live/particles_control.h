// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "app/view/view_control.h"
#include "exhibit/state/particles_now.h"

namespace afm::exhibit {
class JamWatch;
class ParticleTask;
class PushPlanner;
struct WallState;
}  // namespace afm::exhibit
namespace afm::scene {
class AdjustedSet;
enum class PushSetting : std::uint8_t;
struct PushRefusal;
}  // namespace afm::scene
namespace afm::input {
struct Ray;
}

namespace afm::app {

struct ViewParts;

// Shows the particles as moved by the servo, requests that pushes be taken back, keeps the score of the task, and plans
// pushes.
class ParticlesControl final : public ViewControl {
 public:
  // `set` must outlive the object.
  ParticlesControl(ViewParts& parts, const scene::ParticleSet& set);
  ~ParticlesControl() override;

  // Takes the newest push back, after the force has been removed from the hand.
  void take_back();

  // Plans another sphere or another place for it, or lets a groove guide the hand along the plan.
  void plan_next_particle();
  void plan_next_place();
  void toggle_groove();

  // Takes a second look at the particles near the tip, at levels 1 and 2, as soon as the tip is lifted.
  void look_again();

  // Selects the next load of a look, gentle or not.
  void next_look_load();

  // Selects the next value of a setting among particles, such as the other tool, or reports why there is none.
  void choose_next(scene::PushSetting setting);

  // Announces the next setting, or selects the next value of the setting last announced.
  void mark_next_setting();
  void change_marked_setting();

  void update(const ViewFrame& frame) override;
  void add_to_moment(exhibit::Moment& now, ViewFrame& frame) override;
  void restart(Restart what) override;

  // Guidance for a tip that leaves marks, while the force is on.
  std::optional<std::string> guidance(const exhibit::Phrases& phrases) const override;

 private:
  enum class Order { None, TakeBack, PutBack, Look };

  // Settings for the servo; `text` names the changed one in the log.
  void choose(const scene::PushSettings& settings, const std::string& text);

  // Empty if the settings can be used here.
  std::optional<scene::PushRefusal> refusal(const scene::PushSettings& settings) const;

  // Requests an order; the servo only carries it out without force, so it waits until there is none.
  void give(Order order);

  void begin_task();

  // Sends a waiting order once the servo can carry it out.
  void carry_out(std::int64_t now_ns);

  // Announces that the pattern is done.
  void follow_task();

  // Hides the picture of a blind task, and announces that its particle is far enough.
  void follow_blind();

  // Shows the set with the settings that the servo uses, and announces changed ones.
  void follow_settings();

  // Announces that the particles are jammed.
  void follow_jam();

  // Makes the servo sweep the particles during a look whose load is not gentle.
  void sweep(const ViewFrame& frame);

  bool point(const input::Ray& ray);
  void send_plan();

  ViewParts& parts_;
  const scene::ParticleSet& set_;  // set with its own settings
  exhibit::ParticlesNow now_;
  std::unique_ptr<exhibit::PushPlanner> planner_;
  std::unique_ptr<exhibit::WallState> shown_;  // state of the wall in the newest frame
  Order order_ = Order::None;
  std::unique_ptr<scene::AdjustedSet> adjusted_;
  std::unique_ptr<exhibit::JamWatch> jam_;
  scene::PushSettings settings_{};               // settings in use, as last announced
  std::optional<std::size_t> marked_;            // index into kPushSettings; its size means the load of a look
  std::size_t look_load_ = 0;                    // index into the loads
  bool far_enough_ = false;                      // true: arrival at the end of the line already announced
  bool sweeps_ = false;                          // true: servo informed of the current look
  std::unique_ptr<exhibit::ParticleTask> task_;  // task of the set; null: none
};

}  // namespace afm::app
