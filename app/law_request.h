// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "core/result.h"
#include "physics/law.h"

namespace afm::app {

// The law of force that somebody wants to feel.
struct LawRequest {
  std::optional<physics::Law> law = physics::Law::Paper;  // none: the one that suits the contact
  bool dynamic = false;                                   // with the lever's inertia, damping and thermal noise
  physics::LawOptions options;
};

// "auto", "paper", "dmt", "dynamic-dmt" and so on, as the command line names them; an error of wrong usage that lists
// them otherwise. A measured law has no name: it comes with its file.
core::Result<LawRequest> law_request(const std::string& model);

// The name back: "dynamic-auto" too.
std::string name_of(const LawRequest& request);

}  // namespace afm::app
