// SPDX-License-Identifier: Apache-2.0
#include "exhibit/models/user_models.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "curves/image_file.h"
#include "imaging/own_models.h"
#include "scene/graph/pose.h"

namespace afm::exhibit {

namespace {

// Width of the outline, as of the assets' samples; length of its strips at a corner; stations along a side.
constexpr double kLineOfSide = 0.0028, kCornerLengths = 2.5;
constexpr std::size_t kMostStations = 64;
constexpr double kCornerCosine = 0.87;  // a turn of 30 degrees
constexpr glm::vec4 kLineColour(0.004F, 0.004F, 0.005F, 1.0F);

double cross_of(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// Convex hull seen from above, counter-clockwise, without points nearer than `rounding` to the line of their
// neighbours.
std::vector<glm::dvec2> hull_of(std::vector<glm::dvec2> points, double rounding) {
  std::sort(points.begin(), points.end(),
            [](const glm::dvec2& a, const glm::dvec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<glm::dvec2> hull;
  const auto add = [&](const glm::dvec2& point, std::size_t least) {
    while (hull.size() > least) {
      const glm::dvec2 side = hull.back() - hull[hull.size() - 2];
      if (cross_of(side, point - hull.back()) > rounding * glm::length(side)) break;
      hull.pop_back();
    }
    hull.push_back(point);
  };
  for (const glm::dvec2& point : points) add(point, 1);
  const std::size_t lower = hull.size();
  for (auto point = points.rbegin() + 1; point != points.rend(); ++point) add(*point, lower);
  hull.pop_back();
  return hull;
}

// Strips around a body, off its sides and wound inwards.
struct OutlineStrips {
  const std::vector<glm::dvec3>& body;
  double width, bottom;
  scene::Primitive strips{};

  // The highest places of the body near the side from a to b, at equal distances.
  std::vector<glm::dvec3> rim(const glm::dvec2& a, const glm::dvec2& b) const {
    const double length = glm::length(b - a);
    const glm::dvec2 along = (b - a) / length;
    const auto stations =
        static_cast<std::size_t>(std::clamp(std::ceil(0.5 * length / width), 1.0, static_cast<double>(kMostStations)));
    std::vector<double> highest(stations + 1, -std::numeric_limits<double>::infinity());
    for (const glm::dvec3& place : body) {
      const glm::dvec2 from_a = glm::dvec2(place) - a;
      const double way = glm::dot(from_a, along) / length;
      if (std::abs(cross_of(along, from_a)) > width || way < -1e-3 || way > 1.001) continue;
      double& here = highest[static_cast<std::size_t>(std::lround(std::clamp(way, 0.0, 1.0) * double(stations)))];
      here = std::max(here, place.z);
    }
    std::vector<glm::dvec3> rim;
    for (std::size_t i = 0; i <= stations; ++i) {
      const glm::dvec2 at = a + (b - a) * (static_cast<double>(i) / static_cast<double>(stations));
      if (std::isfinite(highest[i])) rim.emplace_back(at, highest[i]);
    }
    return rim;
  }

  void add(const glm::dvec3& from, const glm::dvec3& to, double low_from, double low_to, const glm::dvec2& outward) {
    const auto first = static_cast<std::uint32_t>(strips.vertices.size());
    const glm::vec3 inward(-outward.x, -outward.y, 0.0);
    const glm::dvec3 rise(0.0, 0.0, width);
    for (const auto& [at, low] : {std::pair(from, low_from), std::pair(to, low_to)}) {
      strips.vertices.push_back({glm::vec3(at + rise), inward, kLineColour});
      strips.vertices.push_back({glm::vec3(at.x, at.y, low), inward, kLineColour});
    }
    strips.indices.insert(strips.indices.end(), {first, first + 2, first + 1, first + 1, first + 2, first + 3});
  }

  void add_side(const glm::dvec2& a, const glm::dvec2& b, bool corner_at_a, bool corner_at_b) {
    const glm::dvec2 along = glm::normalize(b - a), outward(along.y, -along.x);
    std::vector<glm::dvec3> places = rim(a, b);
    for (glm::dvec3& place : places) place += glm::dvec3(width * outward, 0.0);
    if (places.size() < 2) return;
    if (corner_at_a) places.front() -= glm::dvec3(width * along, 0.0);
    if (corner_at_b) places.back() += glm::dvec3(width * along, 0.0);
    for (std::size_t i = 1; i < places.size(); ++i) {
      add(places[i - 1], places[i], places[i - 1].z - width, places[i].z - width, outward);
    }
    const glm::dvec3 corner(kCornerLengths * width * along, 0.0);
    if (corner_at_a) add(places.front(), places.front() + corner, bottom, bottom, outward);
    if (corner_at_b) add(places.back() - corner, places.back(), bottom, bottom, outward);
  }
};

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
    own.sample = with_outline(std::move(*sample));
  }
  return own;
}

scene::Scene with_outline(scene::Scene sample) {
  std::vector<glm::dvec3> body;
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
  for (const scene::Primitive& primitive : sample.meshes.front().primitives) {
    for (const scene::Vertex& vertex : primitive.vertices) {
      body.emplace_back(vertex.position);
      low = glm::min(low, body.back());
      high = glm::max(high, body.back());
    }
  }
  if (body.empty()) return sample;
  const double side = std::max(high.x - low.x, high.y - low.y);
  const std::vector<glm::dvec2> hull = hull_of({body.begin(), body.end()}, 1e-4 * side);
  if (hull.size() < 3) return sample;

  OutlineStrips outline{.body = body, .width = kLineOfSide * side, .bottom = low.z};
  const std::size_t count = hull.size();
  const auto turns_at = [&](std::size_t i) {
    const glm::dvec2 here = hull[i % count], before = here - hull[(i + count - 1) % count];
    return glm::dot(glm::normalize(before), glm::normalize(hull[(i + 1) % count] - here)) < kCornerCosine;
  };
  for (std::size_t i = 0; i < count; ++i) {
    outline.add_side(hull[i], hull[(i + 1) % count], turns_at(i), turns_at(i + 1));
  }
  outline.strips.material = static_cast<std::uint32_t>(sample.materials.size());
  sample.materials.push_back({.name = "outline", .metallic = 0.0F, .unlit = true});
  sample.nodes.push_back({"outline", std::nullopt, static_cast<std::uint32_t>(sample.meshes.size()), glm::dmat4(1.0)});
  sample.meshes.push_back({"outline", {std::move(outline.strips)}});
  return sample;
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
