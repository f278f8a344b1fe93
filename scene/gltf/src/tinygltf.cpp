// SPDX-License-Identifier: Apache-2.0
// The only copy of tinygltf. Its shared library is not linked: Debian's libdraco exports an older tinygltf under the
// same names, and the order of the libraries would determine which of the two is called.

// headers that the implementation needs but does not include, or that must not have hidden symbols
#include <fstream>
#include <nlohmann/json.hpp>

#define TINYGLTF_IMPLEMENTATION
#include "gltf_model.h"
