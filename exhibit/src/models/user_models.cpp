// SPDX-License-Identifier: Apache-2.0
#include "exhibit/models/user_models.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "curves/image_file.h"
#include "imaging/own_models.h"
#include "scene/graph/pose.h"

namespace afm::exhibit {

namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

core::Result<UserModels> load_own_models(const std::string& probe_file, const std::string& sample_file,
                                         const curves::TopographyReading& reading) {
  UserModels own;
  if (!probe_file.empty()) {
    auto probe = imaging::load_own_probe(probe_file);
    if (!probe) return tl::unexpected(probe.error());
    own.probe = std::move(*probe);
  }
  if (const auto checked = imaging::check_own_sample(sample_file); !checked) return tl::unexpected(checked.error());
  if (curves::is_image_file(sample_file)) {
    auto topography = load_topography_model(sample_file, reading);
    if (!topography) return tl::unexpected(topography.error());
    own.topography = std::move(*topography);
  } else if (!sample_file.empty()) {
    auto sample = imaging::load_own_sample(sample_file);
    if (!sample) return tl::unexpected(sample.error());
    own.sample = std::move(*sample);
  }
  return own;
}

scene::Scene sample_as(const scene::Scene& sample, const scene::MaterialEntry& material) {
  scene::Scene shown = sample;
  for (const std::string& variant : sample.variants) {
    const std::string name = lower(variant);
    if (name == lower(material.name) || name == lower(material.look) || name == lower(material.title)) {
      scene::choose_variant(shown, variant);
      break;
    }
  }
  return shown;
}

}  // namespace afm::exhibit
