// SPDX-License-Identifier: Apache-2.0
#include "foreign_file.h"

#include <fmt/core.h>

#include <optional>
#include <string_view>

#include "scene/gltf/not_gltf.h"

namespace afm::scene {
namespace {

std::optional<core::FileKind> kind_of(std::span<const std::uint8_t> bytes) {
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return core::file_kind(all.substr(0, core::kFileKindBytes), all.size());
}

}  // namespace

std::string foreign_kind(std::span<const std::uint8_t> bytes) {
  const auto kind = kind_of(bytes);
  return kind ? not_gltf(*kind) : "";
}

std::string foreign_image(std::span<const std::uint8_t> bytes) {
  const auto kind = kind_of(bytes);
  return std::string(kind ? kind->name : "");
}

std::string not_gltf(const core::FileKind& kind) {
  const std::string_view remedy = core::remedy_of(kind.role);
  return fmt::format("it is {}, not glTF; {}", kind.name,
                     remedy.empty() ? "export glTF 2.0 (.glb) from the program that made it" : remedy);
}

}  // namespace afm::scene
