// SPDX-License-Identifier: Apache-2.0
#include "scene/material_library.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>

#include "physics/force_model.h"
#include "physics/quantity_text.h"
#include "scene/shared_blocks.h"
#include "toml_fault.h"

namespace afm::scene {
namespace {

constexpr std::array<std::string_view, 5> kTextKeys{"name", "title", "tip", "medium", "note"};
constexpr std::array<std::string_view, 7> kQuantityKeys{"tip_radius",     "spring_constant",     "sample_stiffness",
                                                        "hamaker",        "mean_surface_energy", "experiment_f_attr",
                                                        "experiment_f_ad"};

template <std::size_t Count>
bool contains(const std::array<std::string_view, Count>& keys, std::string_view key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

// One [[material]].
class MaterialReader {
 public:
  explicit MaterialReader(const toml::table& table) : table_(table) {}

  MaterialEntry read() {
    for (const auto& [key, node] : table_) {
      if (contains(kTextKeys, key.str()) || contains(kQuantityKeys, key.str())) continue;
      throw Fault{
          node.source(), name(key.str()),
          fmt::format("unknown key; known are {}, {}", fmt::join(kTextKeys, ", "), fmt::join(kQuantityKeys, ", "))};
    }

    entry_.name = text(table_, "name", "");
    entry_.title = text(table_, "title", "");
    entry_.tip = text(table_, "tip", "");
    entry_.medium = text(table_, "medium", "");
    if (table_.contains("note")) entry_.note = text(table_, "note", "");
    if (entry_.name.size() >= kNameLength) {
      throw Fault{node_of("name").source(), name("name"), fmt::format("is longer than {} bytes", kNameLength - 1)};
    }

    physics::Interaction& interaction = entry_.interaction;
    interaction.tip_radius = quantity("tip_radius", physics::kLengthUnits);
    interaction.spring_constant = quantity("spring_constant", physics::kStiffnessUnits);
    interaction.sample_stiffness = quantity("sample_stiffness", physics::kStiffnessUnits, physics::Infinity::Allowed);
    interaction.hamaker = quantity("hamaker", physics::kEnergyUnits);
    interaction.mean_surface_energy = quantity("mean_surface_energy", physics::kSurfaceEnergyUnits);
    entry_.experiment_f_attr = magnitude("experiment_f_attr");
    entry_.experiment_f_ad = magnitude("experiment_f_ad");
    check_physics();
    return std::move(entry_);
  }

 private:
  static std::string name(std::string_view key) { return "material." + std::string(key); }

  const toml::node& node_of(std::string_view key) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) throw Fault{table_.source(), name(key), "is missing"};
    return *node;
  }

  // `outer` is the key of the inline table that `table` is, with its dot, or empty for the material itself.
  static std::string text(const toml::table& table, std::string_view key, const std::string& outer) {
    const toml::node* node = table.get(key);
    if (node == nullptr) throw Fault{table.source(), name(outer + std::string(key)), "is missing"};
    const auto value = node->value_exact<std::string>();
    if (!value || value->empty()) {
      throw Fault{node->source(), name(outer + std::string(key)), "must be a text that is not empty"};
    }
    return *value;
  }

  template <class Q>
  Q quantity(std::string_view key, const physics::UnitList<Q>& units,
             physics::Infinity infinity = physics::Infinity::Refused) {
    const toml::node& node = node_of(key);
    const toml::table* pair = node.as_table();
    if (pair == nullptr) {
      throw Fault{node.source(), name(key), "must be written { value = \"number unit\", source = \"citation\" }"};
    }
    const std::string outer = std::string(key) + ".";
    for (const auto& [inner, inner_node] : *pair) {
      if (inner.str() == "value" || inner.str() == "source") continue;
      throw Fault{inner_node.source(), name(outer + std::string(inner.str())), "unknown key; known are value, source"};
    }
    const std::string value = text(*pair, "value", outer);
    const auto parsed = physics::parse_quantity(value, units, infinity);
    if (!parsed.value) throw Fault{pair->get("value")->source(), name(key), parsed.error};
    entry_.sources.push_back({std::string(key), value, text(*pair, "source", outer)});
    return *parsed.value;
  }

  physics::Force magnitude(std::string_view key) {
    const physics::Force force = quantity(key, physics::kForceUnits);
    if (force <= physics::Force()) {
      throw Fault{
          node_of(key).source(), name(key),
          fmt::format("is {}; it must be a positive magnitude", physics::format_quantity(force, physics::kForceUnits))};
    }
    return force;
  }

  void check_physics() const {
    try {
      physics::ApproachRetractModel{entry_.interaction};
    } catch (const physics::UnphysicalValue& error) {
      throw Fault{node_of(error.field()).source(), name(error.field()), error.what()};
    } catch (const std::invalid_argument& error) {
      throw Fault{node_of("mean_surface_energy").source(), name("mean_surface_energy"), error.what()};
    }
  }

  const toml::table& table_;
  MaterialEntry entry_;
};

MaterialLibrary read_library(const toml::table& root) {
  for (const auto& [key, node] : root) {
    if (key.str() != "material") throw Fault{node.source(), std::string(key.str()), "unknown key; known is material"};
  }
  const toml::node* node = root.get("material");
  if (node == nullptr) throw Fault{root.source(), "material", "is missing; the file needs at least one [[material]]"};
  const toml::array* tables = node->as_array();
  if (tables == nullptr || tables->empty()) throw Fault{node->source(), "material", "must be written [[material]]"};

  MaterialLibrary library;
  for (const toml::node& element : *tables) {
    const toml::table* table = element.as_table();
    if (table == nullptr) throw Fault{element.source(), "material", "must be written [[material]]"};
    if (library.materials.size() == kMaxMaterials) {
      throw Fault{table->source(), "material", fmt::format("the file has more than {} materials", kMaxMaterials)};
    }
    MaterialEntry entry = MaterialReader(*table).read();
    if (library.find(entry.name) != nullptr) {
      throw Fault{table->get("name")->source(), "material.name", fmt::format("\"{}\" is used twice", entry.name)};
    }
    library.materials.push_back(std::move(entry));
  }
  return library;
}

}  // namespace

const MaterialEntry* MaterialLibrary::find(std::string_view name) const {
  const auto entry =
      std::find_if(materials.begin(), materials.end(), [&](const MaterialEntry& m) { return m.name == name; });
  return entry == materials.end() ? nullptr : &*entry;
}

core::Result<const MaterialEntry*> MaterialLibrary::require(std::string_view name) const {
  if (const MaterialEntry* entry = find(name)) return entry;
  std::string known;
  for (const MaterialEntry& entry : materials) known += (known.empty() ? "" : ", ") + entry.name;
  return core::failure(core::ErrorCategory::WrongUsage,
                       fmt::format("unknown material \"{}\"; known are {}", name, known));
}

core::Result<MaterialLibrary> load_materials(const std::string& path) {
  return read_toml("material file", path, read_library);
}

}  // namespace afm::scene
