// SPDX-License-Identifier: Apache-2.0
// tinygltf's one copy. Its shared library is not linked: Debian's libdraco exports an older tinygltf under the same
// names, and which of the two a call would reach depends on the order of the libraries.

// what its implementation needs and includes nowhere, or with hidden symbols
#include <fstream>
#include <nlohmann/json.hpp>

#define TINYGLTF_IMPLEMENTATION
#include "gltf_model.h"
