// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace afm::app {

// Values of --wand, --wand-file and --head.
struct WandOptions {
  std::string source = "auto";  // auto, hid[:NAME], dtrack[:ADDRESS:PORT], sim or mouse
  std::string file{};           // wand file; empty: none
  std::string head{};           // dtrack:BODY[@ADDRESS:PORT], sim:FILE, or empty: head of the wand file, if any
};

}  // namespace afm::app
