// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/view/view_control.h"
#include "app/view/view_guide.h"

namespace afm::exhibit {
struct LessonTarget;
class LiveLesson;
}  // namespace afm::exhibit

namespace afm::app {

struct ViewParts;

// A lesson at the live window, as a guide for the other controls.
class LessonControl final : public ViewControl, public ViewGuide {
 public:
  // Both arguments must outlive the object.
  LessonControl(ViewParts& parts, exhibit::LiveLesson& lesson);

  void skip();
  void try_again();

  bool number(std::size_t number) override;
  void step(int steps) override;
  void enter() override;
  void press(const Pointed& pointed, const input::Ray& ray) override;
  std::string spoken(const std::string& line) override;

  void update(const ViewFrame& frame) override;
  void add_to_moment(exhibit::Moment& now, ViewFrame& frame) override;
  std::optional<std::string> guidance(const exhibit::Phrases& phrases) const override;
  void add_to_session(servo::WallFrame& shown) const override;
  void add_to_picture(render::FrameState& picture, const ViewFrame& frame) override;
  void restart(Restart what) override;

 private:
  std::optional<exhibit::LessonTarget> target_at(const input::Ray& ray) const;
  void follow_hand();
  void put_particles_back(std::int64_t now_ns);
  bool asks() const;  // true if an answer is due

  ViewParts& parts_;
  exhibit::LiveLesson& lesson_;
  bool far_enough_ = false;  // true: arrival at the end of the line already announced
  std::string said_, line_;  // spoken text of the newest prompt, and guidance after it
};

}  // namespace afm::app
