// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace afm::scene {

// Name of a file that is not glTF, found from its bytes, with the remedy: "it is an
// STL file; export glTF 2.0 (.glb) instead". Empty for everything else.
std::string foreign_kind(std::span<const std::uint8_t> bytes);

// Same for a file that is neither PNG nor JPEG: "a KTX2 image". Empty if unknown.
std::string foreign_image(std::span<const std::uint8_t> bytes);

}  // namespace afm::scene
