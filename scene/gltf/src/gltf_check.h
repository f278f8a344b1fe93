// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "gltf_schema.h"
#include "scene/gltf/gltf_loader.h"

namespace afm::scene {

using Json = nlohmann::json;

// Checks a JSON text against the schema, so that later code can rely on the presence, type and range of every member,
// and on every reference. Throws a GltfError that names the location: "/meshes/0/primitives/1".
//
// The check of the header comes first and leaves the rest unchanged. The other one removes everything unknown to the
// schema, including all `extras` except TouchAFM's own on nodes. It writes integers as such ("4.0" becomes 4) and other
// numbers with a point, which is how tinygltf distinguishes them. Numbers that an exporter has rounded beyond their
// range become its limit, with a note.
void check_gltf_header(Json& document);
void check_gltf_document(Json& document, GltfWarnings& notes);

}  // namespace afm::scene
