// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "curves/sample_model.h"
#include "curves/tapping/driven_setup.h"
#include "scene/samples/material_library.h"
#include "support/places.h"

namespace afm::test {

// Hand on the sample of docs/tapping.md under a lever of 40 N/m at 300 kHz, Q = 400, A0 = 20 nm.
inline curves::TappedHand tapped_hand() {
  curves::TappedHand hand;
  hand.choice.mode = "tapping";
  hand.choice.numbers.free_amplitude = "20nm";
  hand.model = "dmt";
  hand.values = {{"spring-constant", "40N/m"}, {"resonance", "300kHz"}, {"quality-factor", "400"},
                 {"tip-radius", "20nm"},       {"hamaker", "64zJ"},     {"work-of-adhesion", "62.4mJ/m2"},
                 {"reduced-modulus", "1.5GPa"}};
  return hand;
}

inline curves::SampleModel tapped_sample() {
  const auto library = scene::load_materials(support::source("assets/materials.toml")).value();
  return curves::make_sample_model(curves::tapped_setup(*library.find("mica"), tapped_hand()).value()).value();
}

}  // namespace afm::test
