// SPDX-License-Identifier: Apache-2.0
#include "scene/graph/animation.h"

#include <algorithm>

namespace afm::scene {
namespace {

// Keys on both sides of a time, and its position between them: 0 at the first, 1 at the second.
struct Place {
  std::size_t before = 0;
  std::size_t after = 0;
  float along = 0.0F;
  float step_s = 0.0F;
};

Place place_of(const Track& track, float time_s) {
  const std::vector<float>& times = track.times_s;
  const auto next = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time_s) - times.begin());
  if (next == 0) return {};
  if (next == times.size()) return {next - 1, next - 1, 0.0F, 0.0F};
  const float step = times[next] - times[next - 1];
  return {next - 1, next, (time_s - times[next - 1]) / step, step};
}

// Index of the first number of a key's value; cubic splines have a tangent on each side of it.
std::size_t value_at(const Track& track, std::size_t key) {
  return track.interpolation == Interpolation::CubicSpline ? (3 * key + 1) * track.width : key * track.width;
}

// Cubic spline of glTF 2.0, appendix C.5.
float hermite(const Track& track, const Place& place, std::size_t i) {
  const float t = place.along, t2 = t * t, t3 = t2 * t;
  const std::size_t from = value_at(track, place.before) + i, to = value_at(track, place.after) + i;
  const float out_tangent = place.step_s * track.values[from + track.width];
  const float in_tangent = place.step_s * track.values[to - track.width];
  return (2 * t3 - 3 * t2 + 1) * track.values[from] + (t3 - 2 * t2 + t) * out_tangent +
         (3 * t2 - 2 * t3) * track.values[to] + (t3 - t2) * in_tangent;
}

glm::dquat rotation_at(const Track& track, std::size_t key) {
  const float* q = &track.values[value_at(track, key)];
  return glm::normalize(glm::dquat(glm::quat(q[3], q[0], q[1], q[2])));
}

}  // namespace

void sample(const Track& track, float time_s, std::vector<float>& value) {
  const Place place = place_of(track, time_s);
  value.resize(track.width);
  for (std::size_t i = 0; i < track.width; ++i) {
    const float from = track.values[value_at(track, place.before) + i];
    const float to = track.values[value_at(track, place.after) + i];
    switch (track.interpolation) {
      case Interpolation::Step:
        value[i] = from;
        break;
      case Interpolation::Linear:
        value[i] = from + place.along * (to - from);
        break;
      case Interpolation::CubicSpline:
        value[i] = hermite(track, place, i);
        break;
    }
  }
}

glm::dquat sample_rotation(const Track& track, float time_s) {
  const Place place = place_of(track, time_s);
  if (track.interpolation == Interpolation::Linear) {
    return glm::slerp(rotation_at(track, place.before), rotation_at(track, place.after),
                      static_cast<double>(place.along));
  }
  std::vector<float> q;
  sample(track, time_s, q);
  const glm::dquat rotation(glm::quat(q[3], q[0], q[1], q[2]));
  const double length = glm::length(rotation);
  return length > 0 ? rotation / length : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

}  // namespace afm::scene
