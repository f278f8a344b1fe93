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

// A law of force as the servo uses it: two monotone branches F(Z) of the lever's force and the two Z at which they end.
// Built when a material is chosen, constant afterwards, shared between threads.
struct LawTables {
  Law law = Law::Paper;
  ContactParameters contact;
  BranchTable free;
  BranchTable attached;
  // Of a recorded curve: the contact while it is being pressed deeper than before, up to Z_jtc, and how far the hand
  // rises from the deepest place until it is on the attached branch. Zero: the attached branch holds both ways.
  BranchTable pressed;
  Length turn;
  Length pressed_to;  // deepest recorded position
  CycleFigures figures;
  Length contact_gap;  // D while attached

  // In contact at `z`, after the tip was pressed down to `lowest`, at or below `z`. What it was pressed to counts, not
  // which way it moves: a wiggle costs no work. Never below the attached branch, so that no path gives work.
  Force contact_force(Length z, Length lowest) const noexcept;
};

// Builds the tables of a law with the lever and the support of `interaction`. Every fold is where dF/dh = k' (3.1).
// With an infinite spring constant the tables are those of fixed grips: the law itself, latched, as dynamics need it.
// Throws std::invalid_argument (UnphysicalValue where one field is to blame) for values that have no such law. Takes
// below 5 ms and allocates: never in the servo's tick. Not for Law::Measured.
std::shared_ptr<const LawTables> build_law_tables(Law law, const ContactParameters& contact,
                                                  const LawOptions& options = {});

// The same for a law that is given as its two branches.
std::shared_ptr<const LawTables> build_law_tables(Law name, const ForceLaw& law, const ContactParameters& contact);

// A recorded curve as a law: two branches of points along rising Z, smoothed by the caller. Each holds one jump,
// between two neighbours. Above its jump the approach is the free branch, below it the contact as it is pressed;
// below its jump the retract is the attached branch, and above it nothing is used: an instrument records there how its
// lever swings. Sessions of version 0.1.0 do not know their jumps: there a jump is the step at which F rises most
// steeply with Z, Z_jtc is the first point above it, and the attached branch holds both ways. Between points F is a
// monotone cubic. A recorded curve has no potential, so that its jump off contact is said to lose what the loop does,
// and no critical stiffness but infinity. `interaction` is that of lever, tip and sample as far as they are known.
//
// Throws std::invalid_argument as validate() does, if a branch has fewer than eight points or more than 65536, or
// points that are not finite or do not rise in Z, and if the curve has no loop: Z_joc not above Z_jtc, or no pull on
// the tip before it jumps off.
struct MeasuredPoint {
  Length z;
  Force force;
};
struct MeasuredJumps {
  std::uint32_t approach = 0;  // points below the jump; 0: not known
  std::uint32_t retract = 0;
};
std::shared_ptr<const LawTables> measured_law_tables(std::span<const MeasuredPoint> approach,
                                                     std::span<const MeasuredPoint> retract,
                                                     const ContactParameters& contact, MeasuredJumps jumps = {});

}  // namespace afm::physics
