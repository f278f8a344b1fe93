// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "scene/display/blend.h"
#include "scene/display/stereo_layout.h"
#include "scene/display/warp_mesh.h"

// Walls, viewers and eyes: pure arithmetic in the room frame (metres, right-handed, +y up), double precision.
namespace afm::scene {

// A flat rectangular screen, given by three measured corners as seen by a viewer in front of it.
struct Screen {
  std::string name;
  glm::dvec3 lower_left{0.0};
  glm::dvec3 lower_right{0.0};
  glm::dvec3 upper_left{0.0};
  std::optional<ScreenBlend> blend{};  // overlap with other screens

  double width_m() const;
  double height_m() const;
  glm::dvec3 normal() const;  // unit vector towards the viewer
  glm::dvec3 center() const;
};

struct HeadPose {
  glm::dvec3 position_m{0.0};
  glm::dquat room_from_head{1.0, 0.0, 0.0, 0.0};  // orientation; the head looks along -z, +x is to its right
};

enum class Eye { Left, Right };
inline constexpr std::array<Eye, 2> kEyes{Eye::Left, Eye::Right};

// Depth conventions of the research's test vectors; the program itself uses only VulkanReversedInfinite.
enum class DepthConvention { Vulkan, VulkanReversed, VulkanReversedInfinite, VulkanYUp, OpenGl };

struct EyeView {
  glm::dmat4 projection{1.0};  // clip from view
  glm::dmat4 view{1.0};        // view from room
  glm::dvec3 eye_position_m{0.0};
};

// left = position - R (ipd/2, 0, 0), right = position + R (ipd/2, 0, 0): roll and yaw of the head move the eyes.
// `eye_from_tracker` is the point midway between the eyes, in the head's frame.
glm::dvec3 eye_position(const HeadPose& head, Eye eye, double ipd_m,
                        const glm::dvec3& eye_from_tracker_m = glm::dvec3(0.0));

// Checks that the corners are finite, distinct, and at right angles within a degree (the accuracy of a tape measure).
core::Result<void> check_screen(const Screen& screen);

// True if the screens lie in one plane and have the same upright direction, within the accuracy of a tape measure.
bool in_one_plane(const Screen& a, const Screen& b);

// An eye closer to a screen than this is a measurement error.
inline constexpr double kSmallestEyeDistanceM = 0.01;

// Generalised perspective projection (Kooima 2008): the view basis is the screen's, never the head's. Fails like
// check_screen, or if the eye is not in front of the screen. near_m and far_m > 0; the infinite convention ignores
// far_m.
core::Result<EyeView> off_axis_view(const Screen& screen, const glm::dvec3& eye_position_m, DepthConvention convention,
                                    double near_m, double far_m);

// Near plane of every picture: nothing closer to an eye is drawn.
inline constexpr double kNearM = 0.1;

// Field of view of a headset's eye, as angles from straight ahead, negative to the left and down. It may be asymmetric.
struct FieldOfView {
  double left_rad = 0, right_rad = 0, down_rad = 0, up_rad = 0;
};

// View of a headset's eye, along the eye's own pose, since displays may be canted. Arguments and conventions as for
// off_axis_view(). Failed: an impossible pose or angles, which a headset's runtime may send.
core::Result<EyeView> eye_from_fov(const HeadPose& eye, const FieldOfView& fov, DepthConvention convention,
                                   double near_m, double far_m);

// Rectangle across an eye's line of sight, at this distance, that fills its field of view: the screen for pointing in a
// mirror of a headset's picture.
Screen screen_of_fov(const HeadPose& eye, const FieldOfView& fov, double distance_m);

struct Viewer {
  std::string name = "viewer";
  double ipd_m = 0.063;
  std::string head = "none";        // "none", or the tracked body of the head: "dtrack:0"
  glm::dvec3 eye_from_head_m{0.0};  // midpoint of the eyes, in the tracked body's frame
  HeadPose sweet_spot;              // assumed head pose without a tracker
};

// Dodgson 2004: 45 to 80 mm covers nearly all adults, children from 40 mm. Values outside are probably in the wrong
// unit.
inline constexpr double kSmallestIpdM = 0.030;
inline constexpr double kLargestIpdM = 0.090;

struct PixelRect {
  glm::ivec2 offset_px{0};  // from the top left corner of the desktop, which spans all monitors
  glm::uvec2 size_px{0};
};

bool overlap(const PixelRect& a, const PixelRect& b);

// Output that shows a screen's picture.
struct Output {
  std::string name;
  std::size_t screen = 0;           // index into Wall::screens
  std::optional<std::size_t> node;  // index into Wall::nodes; none: the machine with the hand
  StereoMode mode = StereoMode::Mono;
  std::optional<Eye> eye;  // mode dual only: eye of this picture
  EyeOrder order = EyeOrder::Straight;
  std::string monitor;                  // name in the window system; empty: `rect` is used
  PixelRect rect;                       // without area: the whole monitor
  glm::dmat3 picture_from_output{1.0};  // keystone, see render::Composition

  // Shared with the windows and with pictures still being drawn; null: none.
  std::shared_ptr<const WarpMesh> warp{};
  std::string warp_file{};  // name in the wall file, relative to that file
  std::shared_ptr<const Blend> blend{};
};

// Another machine that shows outputs of the wall.
struct WallNode {
  std::string name;
  std::string host;  // name or address, as reached from the machine with the hand
};

inline constexpr std::size_t kMostNodes = 32;
inline constexpr std::size_t kLongestNodeName = 31;

struct Wall {
  std::vector<Screen> screens;
  std::vector<WallNode> nodes{};  // may be empty
  std::vector<Output> outputs;    // may be empty
  std::vector<Viewer> viewers;
  std::vector<Output> outputs_elsewhere{};  // outputs of other machines, set by keep_outputs_of()
  std::vector<std::string> unused{};        // elements of the file that the program does not use, one line each
};

// Blending of a picture of that screen by projectors without known properties; null if nothing overlaps it.
std::shared_ptr<const Blend> usual_blend(const Wall& wall, std::size_t screen);

// Height of the room's floor: at y = 0, or at the lowest edge of a screen if that is lower, or a metre below the sweet
// spot if the room's origin is higher.
double floor_height_m(const Wall& wall);

// Keeps only the outputs of a node, or those of the machine with the hand; all others become outputs_elsewhere.
void keep_outputs_of(std::optional<std::size_t> node, Wall& wall);

// Reason why no head can be at this position in front of the wall, such as "0.85 m below the floor"; empty if it is
// plausible.
std::string doubt_of_head(const Wall& wall, const glm::dvec3& head_m);

// Reads and checks a wall file: TOML, or the corners of a ParaView .pvx. The error names file, line and key.
core::Result<Wall> load_wall(const std::string& path);

}  // namespace afm::scene
