// SPDX-License-Identifier: Apache-2.0
#include "physics/law_tables.h"

#include <stdexcept>

#include "paper_tables.h"

namespace afm::physics {

std::shared_ptr<const LawTables> build_law_tables(Law law, const Interaction& interaction, const LawOptions&) {
  validate(interaction);
  if (law == Law::Paper) return std::make_shared<const LawTables>(paper_tables(interaction));
  throw std::invalid_argument("only the paper's law can be built into tables");
}

}  // namespace afm::physics
