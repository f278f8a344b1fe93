// SPDX-License-Identifier: Apache-2.0
#include "graph/gltf_animations.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "graph/gltf_transform.h"

namespace afm::scene {
namespace {

// Numbers per key; 0 for a path that is not part of glTF.
std::size_t width_of(const std::string& path, std::size_t weights) {
  if (path == "translation" || path == "scale") return 3;
  if (path == "rotation") return 4;
  return path == "weights" ? weights : 0;
}

Track read_track(const std::string& path, const tinygltf::AnimationSampler& sampler, const GltfAccessors& accessors,
                 std::size_t width, GltfBudget& budget) {
  const auto fail = [&](std::string_view reason) { throw GltfError(fmt::format("{} {}", path, reason)); };
  Track track;
  track.width = width;
  if (sampler.interpolation == "STEP") track.interpolation = Interpolation::Step;
  if (sampler.interpolation == "CUBICSPLINE") track.interpolation = Interpolation::CubicSpline;
  const std::size_t values_a_key = width * (track.interpolation == Interpolation::CubicSpline ? 3 : 1);
  const Accessor &input = accessors[sampler.input], &output = accessors[sampler.output];
  const auto components = static_cast<std::uint64_t>(output.components);
  if (input.components != 1 || !input.is_float()) fail("has times that are not floats");
  if (output.matrix || (!output.is_float() && !output.normalized)) fail("has an output of a forbidden type");
  if (output.count * components != input.count * values_a_key) {
    fail(fmt::format("has {} output values for {} times of {} each", output.count * components, input.count,
                     values_a_key));
  }
  budget.take(input.count * (1 + values_a_key), sizeof(float));
  track.times_s = accessors.floats(sampler.input);
  track.values = accessors.floats(sampler.output);
  for (std::size_t i = 0; i < track.times_s.size(); ++i) {
    if (track.times_s[i] < 0 || (i > 0 && track.times_s[i] <= track.times_s[i - 1])) {
      fail("has times that are negative or not increasing");
    }
  }
  return track;
}

std::optional<Track>& track_of(AnimatedNode& node, const std::string& path) {
  if (path == "translation") return node.translations;
  if (path == "rotation") return node.rotations;
  return path == "scale" ? node.scales : node.weights;
}

AnimatedNode at_rest(const tinygltf::Model& model, std::size_t index, NodeIndex node) {
  const NodeTransform rest = read_transform(model, index);
  if (rest.matrix) throw GltfError(fmt::format("/nodes/{} is animated but has a matrix", index));
  AnimatedNode animated;
  animated.node = node;
  animated.translation = rest.translation;
  animated.rotation = rest.rotation;
  animated.scale = rest.scale;
  return animated;
}

Animation read_animation(std::size_t index, const tinygltf::Model& model, const GltfAccessors& accessors,
                         const NodePlaces& places, GltfBudget& budget, const Scene& scene) {
  const tinygltf::Animation& source = model.animations[index];
  Animation animation{source.name, {}};
  std::map<NodeIndex, AnimatedNode> animated;
  std::set<std::pair<int, std::string>> seen;
  for (std::size_t i = 0; i < source.channels.size(); ++i) {
    const tinygltf::AnimationChannel& channel = source.channels[i];
    const auto fail = [&](const char* reason) {
      throw GltfError(fmt::format("/animations/{}/channels/{} {}", index, i, reason));
    };
    const auto sampler = static_cast<std::size_t>(channel.sampler);
    if (sampler >= source.samplers.size()) fail("has a sampler that does not exist");
    const auto node = static_cast<std::size_t>(channel.target_node);
    const int mesh = model.nodes[node].mesh;
    const std::size_t weights = mesh < 0 ? 0 : scene.meshes[static_cast<std::size_t>(mesh)].weights.size();
    const std::size_t width = width_of(channel.target_path, weights);
    if (width == 0) fail("animates a property that its node lacks");
    if (!seen.emplace(channel.target_node, channel.target_path).second)
      fail("animates the same property as another channel");
    const auto place = places[node];
    if (!place) continue;
    AnimatedNode& moved = animated.try_emplace(*place, at_rest(model, node, *place)).first->second;
    auto& track = track_of(moved, channel.target_path) = read_track(
        fmt::format("/animations/{}/samplers/{}", index, sampler), source.samplers[sampler], accessors, width, budget);
    animation.length_s = std::max(animation.length_s, track->times_s.back());
  }
  for (auto& [node, moved] : animated) animation.nodes.push_back(std::move(moved));
  return animation;
}

}  // namespace

void read_animations(const tinygltf::Model& model, const GltfAccessors& accessors, const NodePlaces& places,
                     GltfBudget& budget, Scene& scene) {
  for (std::size_t i = 0; i < model.animations.size(); ++i) {
    scene.animations.push_back(read_animation(i, model, accessors, places, budget, scene));
  }
}

}  // namespace afm::scene
