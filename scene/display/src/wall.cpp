// SPDX-License-Identifier: Apache-2.0
#include "scene/display/wall.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace afm::scene {

namespace {

using core::ErrorCategory;
using core::failure;

// The error of a tape measure on a wall is a few millimetres per metre; one degree off square means a swapped or
// mistyped corner.
constexpr double kLargestSquareErrorCosine = 0.0175;
constexpr double kSmallestEdgeM = 1e-3;

constexpr double kFlatM = 5e-3;       // accuracy of a tape measure
constexpr double kSameTurn = 0.9998;  // cosine of one degree

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::string text(const glm::dvec3& v) { return fmt::format("({:g}, {:g}, {:g}) m", v.x, v.y, v.z); }

struct Extent {
  double left, right, bottom, top, near, far;
};

glm::dmat4 projection_matrix(const Extent& e, DepthConvention convention) {
  const bool y_up = convention == DepthConvention::VulkanYUp || convention == DepthConvention::OpenGl;
  const double y_sign = y_up ? 1.0 : -1.0;

  // GLM stores columns: m[column][row]
  glm::dmat4 m(0.0);
  m[0][0] = 2.0 * e.near / (e.right - e.left);
  m[2][0] = (e.right + e.left) / (e.right - e.left);
  // y points down in Vulkan: both terms of the row change sign, or every vertically off-axis frustum is wrong
  m[1][1] = y_sign * 2.0 * e.near / (e.top - e.bottom);
  m[2][1] = y_sign * (e.top + e.bottom) / (e.top - e.bottom);
  m[2][3] = -1.0;
  switch (convention) {
    case DepthConvention::Vulkan:
    case DepthConvention::VulkanYUp:
      m[2][2] = e.far / (e.near - e.far);
      m[3][2] = e.near * e.far / (e.near - e.far);
      break;
    case DepthConvention::VulkanReversed:
      m[2][2] = e.near / (e.far - e.near);
      m[3][2] = e.near * e.far / (e.far - e.near);
      break;
    case DepthConvention::VulkanReversedInfinite:
      m[3][2] = e.near;
      break;
    case DepthConvention::OpenGl:
      m[2][2] = -(e.far + e.near) / (e.far - e.near);
      m[3][2] = -2.0 * e.far * e.near / (e.far - e.near);
      break;
  }
  return m;
}

}  // namespace

double Screen::width_m() const { return glm::length(lower_right - lower_left); }
double Screen::height_m() const { return glm::length(upper_left - lower_left); }
glm::dvec3 Screen::normal() const {
  return glm::normalize(glm::cross(lower_right - lower_left, upper_left - lower_left));
}
glm::dvec3 Screen::center() const { return 0.5 * (lower_right + upper_left); }

core::Result<void> check_screen(const Screen& screen) {
  const auto bad = [&](const std::string& what) {
    return failure(ErrorCategory::BadInputFile, fmt::format("screen \"{}\": {}", screen.name, what));
  };
  if (!finite(screen.lower_left) || !finite(screen.lower_right) || !finite(screen.upper_left)) {
    return bad("a corner is not finite; give lower_left, lower_right and upper_left in metres");
  }
  const glm::dvec3 right = screen.lower_right - screen.lower_left;
  const glm::dvec3 up = screen.upper_left - screen.lower_left;
  if (glm::length(right) < kSmallestEdgeM || glm::length(up) < kSmallestEdgeM) {
    return bad(fmt::format("two corners coincide: lower_left {}, lower_right {}, upper_left {}; measure them again",
                           text(screen.lower_left), text(screen.lower_right), text(screen.upper_left)));
  }
  const double cosine = glm::dot(glm::normalize(right), glm::normalize(up));
  if (std::abs(cosine) > 0.9998) {
    return bad(
        fmt::format("the corners are collinear: lower_left {}, lower_right {}, upper_left {}; measure them again",
                    text(screen.lower_left), text(screen.lower_right), text(screen.upper_left)));
  }
  if (std::abs(cosine) > kLargestSquareErrorCosine) {
    return bad(fmt::format("the angle at lower_left is {:.1f} degrees off a right angle; measure the corners again",
                           std::abs(90.0 - glm::degrees(std::acos(cosine)))));
  }
  return {};
}

bool in_one_plane(const Screen& a, const Screen& b) {
  const auto right_of = [](const Screen& screen) { return glm::normalize(screen.lower_right - screen.lower_left); };
  if (glm::dot(right_of(a), right_of(b)) < kSameTurn) return false;
  for (const glm::dvec3& corner : {b.lower_left, b.lower_right, b.upper_left}) {
    if (std::abs(glm::dot(corner - a.lower_left, a.normal())) > kFlatM) return false;
  }
  return true;
}

glm::dvec3 eye_position(const HeadPose& head, Eye eye, double ipd_m, const glm::dvec3& eye_from_tracker_m) {
  const double side = eye == Eye::Left ? -0.5 : 0.5;
  return head.position_m + head.room_from_head * (eye_from_tracker_m + glm::dvec3(side * ipd_m, 0.0, 0.0));
}

bool overlap(const PixelRect& a, const PixelRect& b) {
  const glm::ivec2 a_end = a.offset_px + glm::ivec2(a.size_px), b_end = b.offset_px + glm::ivec2(b.size_px);
  return a.offset_px.x < b_end.x && b.offset_px.x < a_end.x && a.offset_px.y < b_end.y && b.offset_px.y < a_end.y;
}

void keep_outputs_of(std::optional<std::size_t> node, Wall& wall) {
  const auto others = std::stable_partition(wall.outputs.begin(), wall.outputs.end(),
                                            [&](const Output& output) { return output.node == node; });
  wall.outputs_elsewhere.insert(wall.outputs_elsewhere.end(), others, wall.outputs.end());
  wall.outputs.erase(others, wall.outputs.end());
}

double floor_height_m(const Wall& wall) {
  constexpr double kSitting = 1.0;  // lower than any seated head
  double floor = std::min(0.0, wall.viewers.front().sweet_spot.position_m.y - kSitting);
  for (const Screen& screen : wall.screens) {
    const double lowest = std::min({screen.lower_left.y, screen.lower_right.y, screen.upper_left.y});
    floor = std::min(floor, lowest);
  }
  return floor;
}

std::string doubt_of_head(const Wall& wall, const glm::dvec3& head_m) {
  const double floor = floor_height_m(wall);
  if (head_m.y < floor) return fmt::format("{:.2f} m below the floor", floor - head_m.y);
  for (const Screen& screen : wall.screens) {
    const double before = glm::dot(head_m - screen.lower_left, screen.normal());
    if (before < kSmallestEyeDistanceM) return fmt::format("{:.2f} m behind the screen \"{}\"", -before, screen.name);
  }
  return {};
}

core::Result<EyeView> off_axis_view(const Screen& screen, const glm::dvec3& eye_position_m, DepthConvention convention,
                                    double near_m, double far_m) {
  if (auto checked = check_screen(screen); !checked) return tl::unexpected(checked.error());

  const glm::dvec3 right = glm::normalize(screen.lower_right - screen.lower_left);
  const glm::dvec3 normal = screen.normal();
  const glm::dvec3 up = glm::cross(normal, right);

  const glm::dvec3 to_lower_left = screen.lower_left - eye_position_m;
  const glm::dvec3 to_lower_right = screen.lower_right - eye_position_m;
  const glm::dvec3 to_upper_left = screen.upper_left - eye_position_m;
  const double distance = -glm::dot(to_lower_left, normal);
  if (!(distance >= kSmallestEyeDistanceM)) {
    return failure(ErrorCategory::BadInputFile,
                   fmt::format("screen \"{}\": the eye at {} is {:.3f} m {} the screen; it must be at least "
                               "{} mm in front, on the side where lower_left appears on the left",
                               screen.name, text(eye_position_m), std::abs(distance),
                               distance > 0.0 ? "in front of" : "behind", kSmallestEyeDistanceM * 1e3));
  }

  const double scale = near_m / distance;
  const Extent extent{.left = glm::dot(right, to_lower_left) * scale,
                      .right = glm::dot(right, to_lower_right) * scale,
                      .bottom = glm::dot(up, to_lower_left) * scale,
                      .top = glm::dot(up, to_upper_left) * scale,
                      .near = near_m,
                      .far = far_m};

  EyeView result;
  result.projection = projection_matrix(extent, convention);
  const glm::dmat4 view_from_axes = glm::transpose(
      glm::dmat4(glm::dvec4(right, 0.0), glm::dvec4(up, 0.0), glm::dvec4(normal, 0.0), glm::dvec4(0, 0, 0, 1)));
  result.view = glm::translate(view_from_axes, -eye_position_m);
  result.eye_position_m = eye_position_m;
  return result;
}

core::Result<EyeView> eye_from_fov(const HeadPose& eye, const FieldOfView& fov, DepthConvention convention,
                                   double near_m, double far_m) {
  constexpr double kRightAngle = 1.5707963267948966;
  constexpr double kUnitError = 1e-3;  // unit length of a runtime's single-precision quaternion
  const auto ordered = [](double low, double high) { return -kRightAngle < low && low < high && high < kRightAngle; };
  if (!ordered(fov.left_rad, fov.right_rad) || !ordered(fov.down_rad, fov.up_rad)) {
    return failure(ErrorCategory::Failed,
                   fmt::format("no eye has a field of view from {:g} to {:g} rad and from {:g} to {:g} rad",
                               fov.left_rad, fov.right_rad, fov.down_rad, fov.up_rad));
  }
  if (!finite(eye.position_m) || !(std::abs(glm::length(eye.room_from_head) - 1.0) < kUnitError)) {
    return failure(ErrorCategory::Failed, fmt::format("no eye is at {} with that orientation", text(eye.position_m)));
  }
  const glm::dquat turn = glm::normalize(eye.room_from_head);
  const Extent extent{.left = near_m * std::tan(fov.left_rad),
                      .right = near_m * std::tan(fov.right_rad),
                      .bottom = near_m * std::tan(fov.down_rad),
                      .top = near_m * std::tan(fov.up_rad),
                      .near = near_m,
                      .far = far_m};
  EyeView result;
  result.projection = projection_matrix(extent, convention);
  result.view = glm::translate(glm::mat4_cast(glm::conjugate(turn)), -eye.position_m);
  result.eye_position_m = eye.position_m;
  return result;
}

Screen screen_of_fov(const HeadPose& eye, const FieldOfView& fov, double distance_m) {
  const auto corner = [&](double across_rad, double up_rad) {
    const glm::dvec3 in_eye(std::tan(across_rad), std::tan(up_rad), -1.0);
    return eye.position_m + eye.room_from_head * (distance_m * in_eye);
  };
  return {.name = "field of view",
          .lower_left = corner(fov.left_rad, fov.down_rad),
          .lower_right = corner(fov.right_rad, fov.down_rad),
          .upper_left = corner(fov.left_rad, fov.up_rad)};
}

}  // namespace afm::scene
