// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/clock.h"
#include "core/result.h"
#include "render/context.h"
#include "render/renderer.h"
#include "scene/display/wall.h"

namespace afm::render {

class DeviceSource;
struct HeadsetRuntimeParts;

// Description of a headset and its runtime, as the runtime reports them, for users.
struct HeadsetDescription {
  std::string runtime;  // name and version
  std::string headset;
  glm::uvec2 eye_px{0};              // size recommended by the runtime
  std::optional<double> refresh_hz;  // known only if the runtime reports it before a session runs
  std::vector<std::string> formats;  // picture formats accepted by the runtime, in its order of preference
  std::vector<std::string> missing;  // missing optional extensions, each with the feature lost
};

// Connection to a headset's runtime (OpenXR), loaded at run time. The Context is opened with it, since the runtime
// chooses the device. Must outlive the Headset; one thread.
class HeadsetRuntime {
 public:
  // DeviceMissing, with one line that says what to install or start: no loader, no runtime, no headset, or a runtime
  // without XR_KHR_vulkan_enable2. `manifest` is the runtime's file, used only in that line; the loader finds the file
  // itself.
  static core::Result<std::unique_ptr<HeadsetRuntime>> connect(std::string manifest);
  HeadsetRuntime(const HeadsetRuntime&) = delete;
  HeadsetRuntime& operator=(const HeadsetRuntime&) = delete;
  ~HeadsetRuntime();

  const std::string& runtime_name() const;
  const std::string& headset_name() const;
  glm::uvec2 eye_px() const;

  DeviceSource& device_source();
  HeadsetRuntimeParts& parts() { return *parts_; }

 private:
  explicit HeadsetRuntime(std::unique_ptr<HeadsetRuntimeParts> parts);
  std::unique_ptr<HeadsetRuntimeParts> parts_;
};

// One eye of the wearer, in the room, predicted for the time at which the frame is seen.
struct HeadsetEye {
  scene::HeadPose pose;
  scene::FieldOfView fov;
  scene::EyeView view;
};

// The most recently used controller, in the room.
struct HeadsetController {
  bool connected = false;
  bool place_valid = false;
  glm::dvec3 position_m{0.0};
  glm::dquat room_from_controller{1.0, 0.0, 0.0, 0.0};  // orientation; the controller points along its -z
  bool select = false, grab = false, scale = false, home = false;
  glm::dvec2 fly{0.0};  // stick deflection: to the right, away from the user
};

// Shows a renderer's eyes in a headset. In each loop call next_turn(); for Turn::Frame, then call locate_eyes(),
// Renderer::render() with these eyes, and show(). If the headset is off, lost or frozen, nobody sees the picture: the
// loop continues, and a lost headset is looked for every kLookAgainNs. One thread, except that the wait for the
// runtime's next frame has its own, because a runtime may block it indefinitely.
class Headset {
 public:
  // `room_from_floor` places the floor's origin below the wearer, who looks along its -z. Failed or DeviceMissing: the
  // runtime accepts none of our picture formats. All arguments must outlive the headset; `context` was opened with
  // `runtime`.
  static core::Result<std::unique_ptr<Headset>> create(HeadsetRuntime& runtime, Context& context, Renderer& renderer,
                                                       const scene::HeadPose& room_from_floor,
                                                       const core::Clock& clock);
  Headset(const Headset&) = delete;
  Headset& operator=(const Headset&) = delete;
  ~Headset();

  enum class Turn {
    Off,     // no running session: headset not worn, or lost
    Frozen,  // no frame requested by the runtime for kFrozenNs
    Hidden,  // requested frame that nobody can see
    Frame
  };

  // Follows the runtime's events and waits for its next frame, until kFrozenNs after the wait began. Calls
  // `while_waiting` every few milliseconds.
  Turn next_turn(const std::function<void()>& while_waiting);

  // Eyes predicted for the time this turn's frame is seen. It first does all the waiting that showing a picture needs,
  // calling `while_waiting` every few milliseconds, so call it last, just before drawing. Empty if the runtime has lost
  // the eyes or provides no image; the frame is then shown without a picture.
  std::optional<std::array<HeadsetEye, 2>> locate_eyes(const std::function<void()>& while_waiting);

  // Number of panels the runtime can show itself, sharper than in the eyes' pictures; used for FrameState::panels_apart
  // of the frame shown. 0 if it has too few layers, or none that fits their pixel format.
  std::size_t most_panels() const;

  // Shows the renderer's newest frame, drawn for the eyes located last, with its panels apart; never waits. False if
  // nobody sees it: there were no eyes, or the runtime is gone.
  bool show();

  // Age of the eye pose in the newest shown frame when the runtime received the frame. None before the first.
  std::optional<std::int64_t> pose_age_ns() const;

  // State in this turn; empty in a turn without a frame.
  const HeadsetController& controller() const;

  // Vibrates the most recently used controller briefly.
  void pulse();

  // Events since the last call, one line each, for the log.
  std::vector<std::string> take_messages();

  static constexpr std::int64_t kFrozenNs = 250'000'000;
  static constexpr std::int64_t kLookAgainNs = 2'000'000'000;

 private:
  struct Parts;
  explicit Headset(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

// Connects to the runtime and queries everything it reports without showing a picture. DeviceMissing as in
// HeadsetRuntime::connect().
core::Result<HeadsetDescription> describe_headset(std::string manifest);

}  // namespace afm::render
