// SPDX-License-Identifier: Apache-2.0
#include "curves/felt_sources.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "curves/contact_options.h"
#include "curves/curve_output.h"
#include "scene/shared/shared_segment.h"

namespace afm::curves {

namespace {

using json = nlohmann::ordered_json;

constexpr const char* kChanged = "changed while it was felt";
constexpr const char* kOnlyRecorded = "recorded in the session, without a source";

std::vector<scene::SourcedValue> sources_of(const ContactSetup& felt, const ContactSetup& loaded) {
  std::vector<scene::SourcedValue> sources = acting_sources(felt);
  // the law is a curve that an instrument recorded
  if (felt.model.law == physics::Law::Measured) {
    const std::string& title = loaded.material.title;
    sources.insert(sources.begin(), {"law", felt.used_model(), title.empty() ? kOnlyRecorded : title, false});
  }
  if (felt.friction == physics::FrictionLaw::None) return sources;
  const auto& friction = loaded.material.friction_sources;
  sources.insert(sources.end(), friction.begin(), friction.end());
  return sources;
}

constexpr double kRounding = 1e-12;  // largest relative difference in the rounding of different versions

bool is_same(std::optional<double> si, std::optional<double> loaded) {
  return si == loaded || (si && loaded && std::abs(*si - *loaded) <= kRounding * std::abs(*loaded));
}

// Sources in the text of felt_sources().
std::vector<scene::SourcedValue> sources_of(const std::string& recorded) {
  std::vector<scene::SourcedValue> sources;
  const json members = json::parse(recorded);
  for (const auto& [key, source] : members.items()) {
    sources.push_back({key, source.at("value").get<std::string>(), source.at("source").get<std::string>(),
                       source.at("estimated").get<bool>()});
  }
  return sources;
}

}  // namespace

ContactSetup felt_setup(const ContactSetup& loaded, const scene::SharedContact& felt, const std::string& otherwise) {
  ContactSetup setup = loaded;
  auto& sources = setup.material.sources;
  const bool unknown = sources.empty();
  // without a source of W the contact would have none
  if (unknown) sources.push_back({"work_of_adhesion", {}, otherwise, false});
  setup.material.contact = felt.contact;
  setup.material.lever = felt.lever;
  setup.law_options = scene::law_options(felt);
  setup.friction = felt.friction.law;
  setup.model = {};
  setup.model.text = physics::name_of(felt.law);
  setup.model.law = felt.law;
  setup.model.dynamic = felt.dynamic != 0;
  setup.model.driven = scene::taps(felt);
  for (const ContactParameter& parameter : contact_parameters()) {
    const auto si = parameter.get(setup);
    if (!si || !acts(parameter, setup.model) || (!unknown && is_same(si, parameter.get(loaded)))) continue;
    override_parameter(setup, parameter, *si, format_parameter(parameter, *si), otherwise);
  }
  return setup;
}

std::string felt_sources(const ContactSetup& loaded, const scene::SharedContact& felt) {
  return sources_json(sources_of(felt_setup(loaded, felt, kChanged), loaded)).dump();
}

nlohmann::ordered_json session_numbers(const std::string& material, const scene::SharedContact& felt,
                                       const std::string& recorded, const std::string& assets_dir) {
  ContactSetup loaded;
  loaded.material.name = material;
  if (recorded.empty()) {
    ContactOptions built_in;
    built_in.assets_dir = assets_dir;
    const auto library = load_materials(built_in);
    const scene::MaterialEntry* const entry = library ? library->find(material) : nullptr;
    if (entry != nullptr) loaded.material = *entry;
  }
  const ContactSetup setup = felt_setup(loaded, felt, kOnlyRecorded);
  json result;
  json& parameters = result["parameters"] = parameters_json(setup);
  // numbers that the session does not contain
  parameters.erase("tip");
  parameters.erase("medium");
  add_sources(result, recorded.empty() ? sources_of(setup, loaded) : sources_of(recorded));
  return result;
}

std::string source_lines(const std::string& recorded) {
  std::string lines;
  if (recorded.empty()) return lines;
  for (const scene::SourcedValue& source : sources_of(recorded)) lines += source_line(source);
  return lines;
}

}  // namespace afm::curves
