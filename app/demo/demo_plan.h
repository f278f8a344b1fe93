// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "curves/contact_setup.h"
#include "curves/measured_material.h"
#include "curves/tapping/tapped_hand.h"
#include "physics/friction/friction.h"
#include "scene/shared/shared_blocks.h"

namespace afm::exhibit {
struct Stage;
}

namespace afm::app {

struct DemoPlan;

// Samples of the demonstration, as chosen by a user.
struct DemoSamples {
  curves::ModelName model{.text = "paper"};  // force law, without tapping
  std::optional<scene::ScaleMode> scale;
  physics::FrictionLaw friction = physics::FrictionLaw::None;
  std::string probe;              // probe that replaces the materials' lever and tip; empty: none
  std::string measured;           // additional curve file to feel; empty: none
  std::vector<std::string> vary;  // texts such as "spring-constant=0.1N/m:0.4N/m:3"
  curves::TappedHand tapping;
};

// Loads the curve file as an additional material of the stage, if there is one. Uses the lever of the first built-in
// material if the file has none.
core::Result<std::optional<curves::MeasuredMaterial>> load_measured(const DemoSamples& samples,
                                                                    const std::string& assets_dir);

// Samples of the stage as they will be felt, and their variations. WrongUsage, naming the option, if one is impossible,
// or if no hand can bring the lever's swing into the repulsive state.
core::Result<DemoPlan> plan_demo(const exhibit::Stage& stage, const std::optional<curves::MeasuredMaterial>& measured,
                                 const DemoSamples& samples, const std::string& assets_dir);

}  // namespace afm::app
