// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "physics/branch_table.h"
#include "physics/contact_parameters.h"
#include "physics/cycle_figures.h"
#include "physics/force_law.h"
#include "physics/law.h"
#include "physics/units.h"

namespace afm::physics {

class TapTable;

// A force law in the servo's form: two monotone branches F(Z) of the lever's force and the two Z at which they end.
// Built when a material is chosen, constant afterwards, shared between threads.
struct LawTables {
  Law law = Law::Paper;
  ContactParameters contact;
  BranchTable free;
  BranchTable attached;
  // For a recorded curve: the contact while it is pressed deeper than before, up to Z_jtc, and the distance by which
  // the hand rises from the deepest place to reach the attached branch. Zero: the attached branch applies in both
  // directions.
  BranchTable pressed;
  Length turn;
  Length pressed_to;  // deepest recorded position
  CycleFigures figures;
  Length contact_gap;  // gap D while attached
  // A lever that taps (physics/tapping/tapping_model.h): the Z above which its push is not felt, and the push at an
  // amplitude of zero. Zero: it does not tap.
  Length tapped_from;
  Force tapped_full;
  // Swings of a lever with a quality factor too low for averages. Shared, because tables are copied.
  std::shared_ptr<const TapTable> taps;

  // Force in contact at `z`, after the tip was pressed down to `lowest`, at or below `z`. Depends on the deepest place
  // and not on the direction of motion, so an oscillation costs no work. Never below the attached branch, so no path
  // yields work.
  Force contact_force(Length z, Length lowest) const noexcept;
};

// Builds the tables of a law with the lever and the support of `interaction`. Every fold is where dF/dh = k' (3.1).
// With an infinite spring constant the tables are those of fixed grips: the law itself, latched, as the dynamics need
// it. Throws std::invalid_argument (UnphysicalValue if one field is the cause) if no such law exists for the values.
// Takes below 5 ms and allocates, so never call it in the servo's tick. Not for Law::Measured.
std::shared_ptr<const LawTables> build_law_tables(Law law, const ContactParameters& contact,
                                                  const LawOptions& options = {});

// Builds the tables of a law given by its two branches; throws likewise.
std::shared_ptr<const LawTables> build_law_tables(Law name, const ForceLaw& law, const ContactParameters& contact);

// A recorded curve as a law: two branches of points along rising Z, smoothed by the caller. Each contains one jump,
// between two neighbours. The approach above its jump is the free branch, and below it the contact while being pressed;
// the retract below its jump is the attached branch. The retract above its jump is ignored, because an instrument
// records there the oscillation of its lever. In sessions of version 0.1.0, without stored jumps, the jump is the step
// at which F rises most steeply with Z, Z_jtc is the first point above it, and the attached branch applies in both
// directions. Between points F is a monotone cubic. A recorded curve has no potential, so its jump off contact counts
// as dissipating the whole loop, and its critical stiffness is infinite. `interaction` describes lever, tip and sample
// as far as they are known.
//
// Throws std::invalid_argument as validate() does, if a branch has fewer than eight points or more than 65536, or
// points that are not finite or do not rise in Z, and if the curve has no loop: Z_joc not above Z_jtc, or no pull on
// the tip before it jumps off.
struct MeasuredPoint {
  Length z;
  Force force;
};
struct MeasuredJumps {
  std::uint32_t approach = 0;  // number of points of the approach below its jump; 0: unknown
  std::uint32_t retract = 0;
};
std::shared_ptr<const LawTables> measured_law_tables(std::span<const MeasuredPoint> approach,
                                                     std::span<const MeasuredPoint> retract,
                                                     const ContactParameters& contact, MeasuredJumps jumps = {});

}  // namespace afm::physics
