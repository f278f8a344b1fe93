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

// Samples of the demonstration as a user wants to have them felt.
struct DemoSamples {
  curves::ModelName model{.text = "paper"};  // without tapping
  std::optional<scene::ScaleMode> scale;
  physics::FrictionLaw friction = physics::FrictionLaw::None;
  std::string probe;              // probe in place of the materials' lever and tip; empty: none
  std::string measured;           // additional curve file to feel; empty: none
  std::vector<std::string> vary;  // "spring-constant=0.1N/m:0.4N/m:3"
  curves::TappedHand tapping;
};

// Loads the curve file as an additional material of the stage, if there is one. Uses the lever of the first built-in
// material if the file has none.
core::Result<std::optional<curves::MeasuredMaterial>> load_measured(const DemoSamples& samples,
                                                                    const std::string& assets_dir);

// Every sample of the stage as it will be felt, and its variations. WrongUsage, naming the option, for one that cannot
// be; also for a lever whose swing no hand can bring into the repulsive state.
core::Result<DemoPlan> plan_demo(const exhibit::Stage& stage, const std::optional<curves::MeasuredMaterial>& measured,
                                 const DemoSamples& samples, const std::string& assets_dir);

}  // namespace afm::app
