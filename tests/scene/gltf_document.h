// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "scene/gltf/gltf_loader.h"

// A small valid model for tests to damage, and a folder from which to load it.
namespace afm::scene {

inline void put(std::string& bytes, std::uint32_t value, int size = 4) {
  for (int i = 0; i < size; ++i) bytes.push_back(static_cast<char>(value >> (8 * i)));
}

inline void put(std::string& bytes, std::initializer_list<float> values) {
  for (const float value : values) put(bytes, std::bit_cast<std::uint32_t>(value));
}

// A square of four vertices: 48 bytes of positions, then six 16-bit indices.
inline std::string square_binary() {
  std::string bytes;
  put(bytes, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  for (const std::uint32_t index : {0U, 1U, 2U, 0U, 2U, 3U}) put(bytes, index, 2);
  return bytes;
}

inline nlohmann::json square_json() {
  return nlohmann::json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"name": "sample", "children": [1]}, {"name": "surface", "mesh": 0}],
    "meshes": [{"name": "square", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
    "materials": [{"name": "mica"}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                  {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
    "buffers": [{"byteLength": 60}]})");
}

// Adds bytes as a separate buffer view; returns its index.
inline std::size_t add_view(nlohmann::json& document, std::string& binary, const std::string& bytes) {
  while (binary.size() % 4 != 0) binary += '\0';
  document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}});
  binary += bytes;
  document["buffers"][0]["byteLength"] = binary.size();
  return document["bufferViews"].size() - 1;
}

inline std::size_t add_accessor(nlohmann::json& document, std::size_t view, int component_type, int count,
                                const char* type, bool normalized = false) {
  document["accessors"].push_back({{"bufferView", view},
                                   {"componentType", component_type},
                                   {"count", count},
                                   {"type", type},
                                   {"normalized", normalized}});
  return document["accessors"].size() - 1;
}

// A PNG image of one red, half transparent pixel.
inline std::string tiny_png() {
  constexpr unsigned char kBytes[]{0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x48,
                                   0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x06, 0x00, 0x00,
                                   0x00, 0x1F, 0x15, 0xC4, 0x89, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x44, 0x41, 0x54, 0x78,
                                   0x9C, 0x63, 0xF8, 0xCF, 0xC0, 0xD0, 0x00, 0x00, 0x04, 0x81, 0x01, 0x80, 0x2C, 0x55,
                                   0xCE, 0xB0, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82};
  return std::string(std::begin(kBytes), std::end(kBytes));
}

inline std::string glb(std::string text, std::string binary) {
  while (text.size() % 4 != 0) text += ' ';
  while (binary.size() % 4 != 0) binary += '\0';
  std::string bytes = "glTF";
  put(bytes, 2);
  put(bytes, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + binary.size()));
  put(bytes, static_cast<std::uint32_t>(text.size()));
  put(bytes, 0x4E4F534A);
  bytes += text;
  put(bytes, static_cast<std::uint32_t>(binary.size()));
  put(bytes, 0x004E4942);
  return bytes + binary;
}

// Writes models into a temporary folder and loads them.
class GltfFolder : public testing::Test {
 protected:
  GltfFolder() : folder_(std::filesystem::path(testing::TempDir()) / ("gltf_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_ / "models");
  }
  ~GltfFolder() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& bytes) const {
    const std::filesystem::path path = folder_ / "models" / name;
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path;
  }
  core::Result<Scene> load(const nlohmann::json& document, const std::string& binary = square_binary()) const {
    return load_gltf(write("model.glb", glb(document.dump(), binary)));
  }
  core::Result<Scene> load_bytes(const std::string& bytes) const { return load_gltf(write("model.glb", bytes)); }

  void expect_refused(const core::Result<Scene>& scene, const std::string& reason) const {
    ASSERT_FALSE(scene) << reason;
    EXPECT_EQ(scene.error().category, core::ErrorCategory::BadInputFile);
    EXPECT_THAT(scene.error().message, testing::AllOf(testing::HasSubstr("cannot load the model '" + folder_.string()),
                                                      testing::HasSubstr(reason), testing::HasSubstr("; "),
                                                      testing::Not(testing::HasSubstr("\n"))));
  }

  std::filesystem::path folder_;
};

}  // namespace afm::scene
