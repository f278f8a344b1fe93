// SPDX-License-Identifier: Apache-2.0
#include "curves/felt_swing.h"

#include <fmt/format.h>

#include <memory>

#include "curves/sample_model.h"
#include "physics/quantity_text.h"
#include "physics/tapping/driven_lever.h"
#include "physics/tapping/felt_swing.h"
#include "physics/tapping/tap_surface.h"
#include "scene/shared/shared_segment.h"

namespace afm::curves {

std::string why_swing_is_lost(const SampleModel& model) {
  if (!model.taps()) return "";
  const scene::SharedContact& felt = model.parameters;
  const physics::DrivenLever lever = scene::tapping_lever(felt);
  const auto surface = std::make_shared<const physics::TapSurface>(felt.law, felt.contact, scene::law_options(felt),
                                                                   physics::Viscosity(felt.viscosity_pa_s));
  const physics::Length largest = physics::largest_swing_of_hand(surface, lever, *model.tables);
  if (largest <= physics::largest_felt_swing(lever)) return "";
  return fmt::format(
      "with the drive {:.3g} % above the resonance this sample enlarges the swing from {} to at least {}, which pulls "
      "the hand; take a drive nearer to the resonance or below it, or a softer sample",
      100.0 * (lever.ratio - 1.0), physics::format_quantity(lever.free_amplitude, physics::kLengthUnits, 3),
      physics::format_quantity(largest, physics::kLengthUnits, 3));
}

}  // namespace afm::curves
