// SPDX-License-Identifier: Apache-2.0
// Invariant: the end of a servo leaves particles in place
#include "servo/reached_places.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>

namespace afm::servo {
namespace reached_places_test {

ReachedPlaces at_rest_in_turn(std::initializer_list<std::uint64_t> digests) {
  ReachedPlaces places;
  for (const std::uint64_t digest : digests) {
    places.add({.digest = digest, .particle = 0});  // while it is pushed
    for (int tick = 0; tick < 3; ++tick) places.add({.digest = digest});
  }
  return places;
}

TEST(ReachedPlaces, LeadBackThroughThePushesOfTheSession) {
  ReachedPlaces places = at_rest_in_turn({1, 2, 3});
  EXPECT_TRUE(places.take_back_to(2));
  EXPECT_TRUE(places.take_back_to(1));
  EXPECT_FALSE(places.take_back_to(9)) << "made before the session";
}

// A push from 1 to 2 before the session, which puts all back to 1, takes that back, and then takes back the push, too.
TEST(ReachedPlaces, AreNotLedAstrayByAPlaceReachedAnotherWay) {
  ReachedPlaces places = at_rest_in_turn({2, 1});
  EXPECT_TRUE(places.take_back_to(2));
  EXPECT_FALSE(places.take_back_to(1));
}

TEST(ReachedPlaces, AreThoseBetweenPushesAlone) {
  ReachedPlaces places;
  EXPECT_FALSE(places.take_back_to(1));
  places.add({.digest = 1});
  places.add({.digest = 2, .particle = 3});
  places.add({.digest = 3});
  EXPECT_FALSE(places.take_back_to(2)) << "reached in the middle of a push";
  EXPECT_TRUE(places.take_back_to(1));
  places.add({.digest = 4});
  EXPECT_TRUE(places.take_back_to(1));
  places.clear();
  EXPECT_FALSE(places.take_back_to(1));
}

}  // namespace reached_places_test
}  // namespace afm::servo
