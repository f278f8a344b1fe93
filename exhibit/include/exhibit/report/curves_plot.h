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

// Plots of the sessions' whole curves: one with all of them and, if the largest loop dwarfs the smallest, another
// around the smallest. Self-contained SVG elements, one below the other.
std::string curves_svg(std::span<const LabelledSession> sessions, const Phrases& phrases);

}  // namespace afm::exhibit
