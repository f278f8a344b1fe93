// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "curves/contact_options.h"

namespace afm::python {

// Folder with materials.toml and probes.toml, of a build or an installation.
std::string assets_dir();

// touchafm.Contact: the options of a user, and the resulting contact. Immutable.
class Contact {
 public:
  // Throws Refusal and std::invalid_argument.
  explicit Contact(curves::ContactOptions options);

  const curves::ContactOptions& options() const { return options_; }
  const curves::ContactSetup& setup() const { return setup_; }

  // The contact with another law; nullopt: its own law.
  curves::ContactSetup with_law(const std::optional<std::string>& law) const;

 private:
  curves::ContactOptions options_;
  curves::ContactSetup setup_;
};

}  // namespace afm::python
