// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "exhibit/words/phrases.h"
#include "servo/session_file.h"

namespace afm::exhibit {

struct LabelledSession {
  std::string label;
  const servo::RecordedSession* session = nullptr;
};

// The whole curves of the sessions as plots: all together, and, where the largest loop dwarfs the smallest, the same
// around that. Self-contained SVG elements, one below the other.
std::string curves_svg(std::span<const LabelledSession> sessions, const Phrases& phrases);

}  // namespace afm::exhibit
