// SPDX-License-Identifier: Apache-2.0
#include "input/simulated_person.h"

#include <gtest/gtest.h>

namespace afm::input {
namespace simulated_person_test {

constexpr std::int64_t kFrameNs = 50'000'000;

// A tip that holds on keeps its sample: the servo changes it only once the hand has lifted.
TEST(SimulatedPerson, LiftsTheTipOffTheOldSampleBeforeWaitingForAnother) {
  SimulatedPerson person(glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0), HandPath{});
  scene::TipState tip{.material = 0, .phase = physics::Phase::Attached, .servo_state = scene::ServoState::Running};
  person.begin(glm::dvec3(0.0, 1.0, -2.0), 1, 0);
  std::int64_t now_ns = 0;
  for (; now_ns < 3'000'000'000; now_ns += kFrameNs) person.update(now_ns, tip);
  EXPECT_EQ(person.step(), SimulatedPerson::Step::PressSelect);
  EXPECT_EQ(person.hand().target_m[1], HandPath{}.lift_m);
  EXPECT_EQ(person.hand().revision, 1U) << "one stroke";

  tip.acknowledged.hand_script = person.hand().revision;
  tip.phase = physics::Phase::Free;
  tip.servo_state = scene::ServoState::Disarmed;
  tip.material = 1;
  person.update(now_ns, tip);
  EXPECT_EQ(person.step(), SimulatedPerson::Step::Lift);
}

TEST(SimulatedPerson, LeavesAFreeTipWhereItIsUntilItsSampleLiesUnderIt) {
  SimulatedPerson person(glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0), HandPath{});
  const scene::TipState tip{.material = 0, .phase = physics::Phase::Free};
  person.begin(glm::dvec3(0.0, 1.0, -2.0), 1, 0);
  for (std::int64_t now_ns = 0; now_ns < 3'000'000'000; now_ns += kFrameNs) person.update(now_ns, tip);
  EXPECT_EQ(person.hand().revision, 0U);
}

// A button that was pressed during a fault, as while a headset was lost, counts only once it has been let go.
TEST(SimulatedPerson, PressesTurnOnAgainAfterAFault) {
  SimulatedPerson person(glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0), HandPath{});
  scene::TipState tip{.material = 1, .phase = physics::Phase::Free, .servo_state = scene::ServoState::Fault};
  person.begin(glm::dvec3(0.0, 1.0, -2.0), 1, 0);
  std::int64_t now_ns = 0;
  const auto go_on = [&](std::int64_t until_ns) {
    int presses = 0;
    for (; now_ns < until_ns; now_ns += kFrameNs) {
      const bool before = person.hand().turn_on_pressed != 0;
      person.update(now_ns, tip);
      if (!before && person.hand().turn_on_pressed != 0) ++presses;
      tip.acknowledged.hand_script = person.hand().revision;
    }
    return presses;
  };
  EXPECT_GE(go_on(10'000'000'000), 2);
  EXPECT_EQ(person.step(), SimulatedPerson::Step::PressTurnOn);
}

}  // namespace simulated_person_test
}  // namespace afm::input
