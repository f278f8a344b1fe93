// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "gltf_schema.h"

namespace afm::scene {

using Json = nlohmann::json;

// Holds a JSON text against the schema, so that nothing behind it need ask whether a member is there, of its type,
// within its range, or refers to what exists. A fault is thrown as a GltfError that names its place:
// "/meshes/0/primitives/1".
//
// The header's check comes first and leaves the rest alone. The other one removes all that the schema does not know,
// `extras` too but for TouchAFM's own of nodes, and writes whole numbers as such ("4.0" becomes 4) and others with a
// point, which is how tinygltf distinguishes them.
void check_gltf_header(Json& document);
void check_gltf_document(Json& document);

}  // namespace afm::scene
