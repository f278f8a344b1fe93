// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "physics/branch_table.h"
#include "physics/cycle_figures.h"
#include "physics/force_law.h"
#include "physics/interaction.h"
#include "physics/law.h"
#include "physics/units.h"

namespace afm::physics {

// A law of force as the servo uses it: two monotone branches F(Z) of the lever's force and the two Z at which they end.
// Built when a material is chosen, constant afterwards, shared between threads.
struct LawTables {
  Law law = Law::Paper;
  Interaction interaction;
  BranchTable free;
  BranchTable attached;
  CycleFigures figures;
  Length contact_gap;  // D while attached
};

// Builds the tables of a law with the lever and the support of `interaction`. Every fold is where dF/dh = k' (3.1).
// With an infinite spring constant the tables are those of fixed grips: the law itself, latched, as dynamics need it.
// Throws std::invalid_argument (UnphysicalValue where one field is to blame) for values that have no such law. Takes
// below 5 ms and allocates: never in the servo's tick. Not for Law::Measured.
std::shared_ptr<const LawTables> build_law_tables(Law law, const Interaction& interaction,
                                                  const LawOptions& options = {});

// The same for a law that is given as its two branches.
std::shared_ptr<const LawTables> build_law_tables(Law name, const ForceLaw& law, const Interaction& interaction);

// A recorded curve as a law. Points along rising Z, each branch monotone in Z and finite; where the branches meet the
// jumps are looked for. `interaction` says what is known of lever and tip. Throws std::invalid_argument.
struct MeasuredPoint {
  Length z;
  Force force;
};
std::shared_ptr<const LawTables> measured_law_tables(std::span<const MeasuredPoint> approach,
                                                     std::span<const MeasuredPoint> retract,
                                                     const Interaction& interaction);

}  // namespace afm::physics
