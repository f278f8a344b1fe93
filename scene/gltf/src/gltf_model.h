// SPDX-License-Identifier: Apache-2.0
#pragma once

// tinygltf is compiled into the program (tinygltf.cpp), without the parts that open files or decode images.
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <string>

#include "gltf_file.h"
#include "scene/gltf/gltf_loader.h"

namespace afm::scene {

// Model as parsed by tinygltf from a checked text: every member satisfies the schema. Buffers are filled to their
// announced size; one without `data` is a placeholder for compressed data. Images are not decoded: they have their
// `uri` or their `bufferView`.
struct GltfModel {
  tinygltf::Model parts;
  SideFiles side_files;
};

// Throws GltfError.
GltfModel read_gltf_model(const std::string& path, GltfWarnings& notes);

// Value of an extension of this name; null if there is none.
const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions, const std::string& name);

// Members of an extension's value.
double number_or(const tinygltf::Value& object, const char* key, double missing);
std::string text_or(const tinygltf::Value& object, const char* key, const char* missing);

}  // namespace afm::scene
