// SPDX-License-Identifier: Apache-2.0
#include "gltf_animations.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <set>

#include "gltf_transform.h"

namespace afm::scene {
namespace {

// How many numbers a key has; 0 for a path that glTF does not know.
std::size_t width_of(const std::string& path, std::size_t weights) {
  if (path == "translation" || path == "scale") return 3;
  if (path == "rotation") return 4;
  return path == "weights" ? weights : 0;
}

Track read_track(const JsonElement& sampler, const GltfAccessors& accessors, std::size_t width, GltfBudget& budget) {
  Track track;
  track.width = width;
  const std::string interpolation = sampler.text("interpolation", "LINEAR");
  if (interpolation == "STEP") {
    track.interpolation = Interpolation::Step;
  } else if (interpolation == "CUBICSPLINE") {
    track.interpolation = Interpolation::CubicSpline;
  } else if (interpolation != "LINEAR") {
    sampler.fail("has an interpolation that glTF does not know");
  }
  const std::size_t values_a_key = width * (track.interpolation == Interpolation::CubicSpline ? 3 : 1);
  const std::uint32_t input_index = sampler.required_index("input", accessors.size());
  const std::uint32_t output_index = sampler.required_index("output", accessors.size());
  const Accessor &input = accessors[input_index], &output = accessors[output_index];
  const auto components = static_cast<std::uint64_t>(output.components);
  if (input.components != 1 || input.type != ComponentType::Float) sampler.fail("has times that are no floats");
  if (output.matrix || (output.type != ComponentType::Float && !output.normalized)) {
    sampler.fail("has an output of a type that it may not have");
  }
  if (output.count * components != input.count * values_a_key) {
    sampler.fail(fmt::format("has {} output numbers for {} times of {} each", output.count * components, input.count,
                             values_a_key));
  }
  budget.take(input.count * (1 + values_a_key), sizeof(float));
  track.times_s = accessors.floats(input_index);
  track.values = accessors.floats(output_index);
  for (std::size_t i = 0; i < track.times_s.size(); ++i) {
    if (track.times_s[i] < 0 || (i > 0 && track.times_s[i] <= track.times_s[i - 1])) {
      sampler.fail("has times that are negative or do not rise");
    }
  }
  return track;
}

std::optional<Track>& track_of(AnimatedNode& node, const std::string& path) {
  if (path == "translation") return node.translations;
  if (path == "rotation") return node.rotations;
  return path == "scale" ? node.scales : node.weights;
}

std::size_t morph_targets(const JsonElement& node, const Scene& scene) {
  const auto mesh = node.index("mesh", scene.meshes.size());
  return mesh ? scene.meshes[*mesh].weights.size() : 0;
}

AnimatedNode at_rest(const JsonElement& element, NodeIndex node) {
  const NodeTransform rest = read_transform(element);
  if (rest.matrix) element.fail("is animated but has a matrix");
  AnimatedNode animated;
  animated.node = node;
  animated.translation = rest.translation;
  animated.rotation = rest.rotation;
  animated.scale = rest.scale;
  return animated;
}

}  // namespace

void read_animations(const JsonElement& root, const GltfAccessors& accessors, const NodePlaces& places,
                     GltfBudget& budget, Scene& scene, GltfNotes& notes) {
  const std::vector<JsonElement> nodes = root.objects("nodes");
  for (const JsonElement& element : root.objects("animations")) {
    Animation& animation = scene.animations.emplace_back();
    animation.name = element.text("name", "");
    const std::vector<JsonElement> samplers = element.objects("samplers");
    std::map<NodeIndex, AnimatedNode> animated;
    std::set<std::pair<std::uint32_t, std::string>> seen;
    for (const JsonElement& channel : element.objects("channels")) {
      const std::uint32_t sampler = channel.required_index("sampler", samplers.size());
      const JsonElement target = channel.required_object("target");
      const std::string path = target.required_text("path");
      const auto node = target.index("node", nodes.size());
      if (path == "pointer" || !node) {
        notes.ignore(fmt::format("animation channel of path '{}': moves no node", path.substr(0, 40)));
        continue;
      }
      const std::size_t width = width_of(path, morph_targets(nodes[*node], scene));
      if (width == 0) target.fail("moves what the node has not");
      if (!seen.emplace(*node, path).second) target.fail("is moved by more than one channel");
      const auto place = places[*node];
      if (!place) continue;
      AnimatedNode& moved = animated.try_emplace(*place, at_rest(nodes[*node], *place)).first->second;
      auto& track = track_of(moved, path) = read_track(samplers[sampler], accessors, width, budget);
      animation.length_s = std::max(animation.length_s, track->times_s.back());
    }
    for (auto& [node, moved] : animated) animation.nodes.push_back(std::move(moved));
  }
}

}  // namespace afm::scene
