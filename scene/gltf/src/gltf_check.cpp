// SPDX-License-Identifier: Apache-2.0
#include "gltf_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "core/enumerators.h"
#include "gltf_error.h"
#include "gltf_members.h"

namespace afm::scene {
namespace {

using Kind = GltfMember::Kind;

// Location of a value in the text: a chain of names and numbers, converted to a path only for an error.
struct Place {
  const Place* parent = nullptr;
  std::string_view name{};
  std::optional<std::size_t> element{};

  std::string path() const {
    if (parent == nullptr) return {};
    return element ? fmt::format("{}/{}", parent->path(), *element) : fmt::format("{}/{}", parent->path(), name);
  }
  [[noreturn]] void fail(std::string_view reason) const {
    throw GltfError(fmt::format("{} {}", parent == nullptr ? "its JSON text" : path(), reason));
  }
};

// Untrusted value, shortened to fit into a line.
std::string quoted(const Json& value) {
  if (value.is_structured()) return value.is_object() ? "an object" : "a list";
  return value.dump(-1, ' ', true, Json::error_handler_t::replace).substr(0, 60);
}

// Accepts 4.0 for 4, because JSON has only one kind of number.
std::optional<std::uint64_t> whole_number(const Json& value) {
  constexpr double kLargestExact = 9007199254740992.0;
  if (value.is_number_unsigned()) return value.get<std::uint64_t>();
  if (!value.is_number_float()) return std::nullopt;
  const auto number = value.get<double>();
  if (!(number >= 0.0 && number <= kLargestExact) || number != std::floor(number)) return std::nullopt;
  return static_cast<std::uint64_t>(number);
}

bool is_among(std::string_view choices, std::string_view value) {
  for (std::size_t begin = 0; begin <= choices.size();) {
    const std::size_t end = std::min(choices.find(' ', begin), choices.size());
    if (choices.substr(begin, end - begin) == value) return true;
    begin = end + 1;
  }
  return false;
}

// Sizes of the lists that other parts refer to, indexed by list.
std::array<std::size_t, kGltfLists> list_sizes(const Json& document) {
  constexpr std::array<const char*, kGltfLists> kPaths{"/accessors",   "/buffers",
                                                       "/bufferViews", "/cameras",
                                                       "/images",      "/extensions/KHR_lights_punctual/lights",
                                                       "/materials",   "/meshes",
                                                       "/nodes",       "/samplers",
                                                       "/scenes",      "/skins",
                                                       "/textures",    "/extensions/KHR_materials_variants/variants"};
  static_assert(kPaths.back() != nullptr && kGltfLists == core::kEnumerators<GltfList>.size());
  std::array<std::size_t, kGltfLists> sizes{};
  for (std::size_t i = 0; i < kGltfLists; ++i) {
    const Json::json_pointer path(kPaths[i]);
    if (document.contains(path) && document[path].is_array()) sizes[i] = document[path].size();
  }
  return sizes;
}

class Checker {
 public:
  Checker(const Json& document, GltfWarnings& notes) : sizes_(list_sizes(document)), notes_(notes) {}

  void check_members(Json& object, std::span<const GltfMember> members, const Place& place) const {
    if (!object.is_object()) place.fail(fmt::format("is {}, not an object", quoted(object)));
    for (const GltfMember& member : members) {
      const auto found = object.find(member.name);
      if (found != object.end()) {
        check_neighbours(object, member, place);
        check_member(*found, member, Place{&place, member.name});
      } else if (member.is_required) {
        place.fail(fmt::format("has no '{}'", member.name));
      }
    }
  }

  // Removes the members that have not been checked.
  static void keep_only(Json& object, std::initializer_list<std::span<const GltfMember>> tables) {
    for (auto member = object.begin(); member != object.end();) {
      bool is_known = false;
      for (const auto members : tables) {
        for (const GltfMember& known : members) is_known |= known.name == member.key();
      }
      member = is_known ? std::next(member) : object.erase(member);
    }
  }

 private:
  static void check_neighbours(const Json& object, const GltfMember& member, const Place& place) {
    if (!member.needs.empty() && !object.contains(member.needs)) {
      place.fail(fmt::format("has a {} but no {}", member.name, member.needs));
    }
    if (member.bars.empty()) return;
    for (const auto& [name, value] : object.items()) {
      if (is_among(member.bars, name)) {
        place.fail(fmt::format("has both {} and {}", member.name, name));
      }
    }
  }

  void check_member(Json& value, const GltfMember& member, const Place& place) const {
    if (!member.is_list) {
      check_value(value, member, place);
      return;
    }
    if (!value.is_array()) place.fail(fmt::format("is {}, not a list", quoted(value)));
    if (value.size() > member.most_elements && member.most_elements >= gltf_member::kMostMaterials) {
      place.fail(fmt::format("is a list of {}, of which TouchAFM reads {} at most; make the model smaller",
                             value.size(), member.most_elements));
    }
    if (value.size() < member.least_elements || value.size() > member.most_elements) {
      place.fail(
          fmt::format("is a list of {}, not of {} to {}", value.size(), member.least_elements, member.most_elements));
    }
    for (std::size_t i = 0; i < value.size(); ++i) check_value(value[i], member, Place{&place, {}, i});
  }

  void check_value(Json& value, const GltfMember& member, const Place& place) const {
    switch (member.kind) {
      case Kind::Text:
        if (!value.is_string()) place.fail(fmt::format("is {}, not a string", quoted(value)));
        break;
      case Kind::Flag:
        if (!value.is_boolean()) place.fail(fmt::format("is {}, not true or false", quoted(value)));
        break;
      case Kind::Choice:
        check_choice(value, member, place);
        break;
      case Kind::Number:
        check_number(value, member, place);
        break;
      case Kind::Whole:
        check_whole(value, member, place);
        break;
      case Kind::Index:
        check_index(value, member.into, place);
        break;
      case Kind::Object:
        check_members(value, member.members, place);
        keep(value, member, place);
        break;
      case Kind::Accessors:
      case Kind::Numbers:
        check_any_members(value, member, place);
        break;
    }
  }

  static void check_choice(Json& value, const GltfMember& member, const Place& place) {
    const auto number = whole_number(value);
    if (number) value = *number;
    const std::string chosen = number ? std::to_string(*number) : value.is_string() ? value.get<std::string>() : "";
    const bool is_number = member.choices[0] >= '0' && member.choices[0] <= '9';
    if (is_number != number.has_value() || chosen.empty() || !is_among(member.choices, chosen)) {
      place.fail(fmt::format("is {}, not one of {}", quoted(value), member.choices));
    }
  }

  void check_number(Json& value, const GltfMember& member, const Place& place) const {
    const double number = value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
    const double highest = member.clamps_above ? std::numeric_limits<double>::max() : member.high + member.slack;
    if (!(number >= member.low - member.slack && number <= highest)) {
      place.fail(fmt::format("is {}, not a number of {:g} to {:g}", quoted(value), member.low, member.high));
    }
    const double used = std::clamp(number, member.low, member.high);
    if (used != number) notes_.correct(fmt::format("{} is {}: drawn as {:g}", place.path(), quoted(value), used));
    value = used;
  }

  static void check_whole(Json& value, const GltfMember& member, const Place& place) {
    const auto number = whole_number(value);
    if (member.is_our_limit && number && static_cast<double>(*number) > member.high) {
      place.fail(fmt::format("is {}, of which TouchAFM reads {:.0f} at most; make the model smaller", quoted(value),
                             member.high));
    }
    if (!number || static_cast<double>(*number) < member.low || static_cast<double>(*number) > member.high) {
      place.fail(fmt::format("is {}, not a whole number of {:.0f} to {:.0f}", quoted(value), member.low, member.high));
    }
    value = *number;
  }

  void check_index(Json& value, GltfList into, const Place& place) const {
    const auto number = whole_number(value);
    const std::size_t size = sizes_[static_cast<std::size_t>(into)];
    if (!number || *number >= size) {
      place.fail(fmt::format("is {}, which does not exist: there are {}", quoted(value), size));
    }
    value = *number;
  }

  void check_any_members(Json& value, const GltfMember& member, const Place& place) const {
    if (!value.is_object()) place.fail(fmt::format("is {}, not an object", quoted(value)));
    for (auto& [name, inner] : value.items()) {
      const Place inner_place{&place, name};
      if (member.kind == Kind::Accessors) {
        check_index(inner, GltfList::Accessors, inner_place);
      } else {
        check_whole(inner, member, inner_place);
      }
    }
  }

  // Keeps TouchAFM's own extras of a node, and drops those of other applications.
  static void keep(Json& object, const GltfMember& member, const Place& place) {
    Json own;
    if (place.parent->name == "nodes" && object.contains("extras") && object["extras"].is_object()) {
      own = object["extras"].value("touchafm", Json());
    }
    keep_only(object, {member.members});
    if (own.is_null()) return;
    const Place role{&place, "extras/touchafm/role"};
    if (!own.is_object() || !own.contains("role") || !own["role"].is_string()) role.fail("is not a string");
    check_choice(own["role"], GltfMember{"role", Kind::Choice, 0, 0, "tip base surface mark"}, role);
    object["extras"] = {{"touchafm", {{"role", own["role"]}}}};
  }

  std::array<std::size_t, kGltfLists> sizes_;
  GltfWarnings& notes_;
};

}  // namespace

void check_gltf_header(Json& document) {
  GltfWarnings none;  // unused, since a header has no numbers
  Checker(document, none).check_members(document, gltf_header(), {});
}

void check_gltf_document(Json& document, GltfWarnings& notes) {
  const Checker checker(document, notes);
  checker.check_members(document, gltf_document(), {});
  Checker::keep_only(document, {gltf_header(), gltf_document()});
}

}  // namespace afm::scene
