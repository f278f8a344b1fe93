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

// What a headset's runtime says of itself and of the headset, for people.
struct HeadsetDescription {
  std::string runtime;  // name and version
  std::string headset;
  glm::uvec2 eye_px{0};              // as the runtime recommends
  std::optional<double> refresh_hz;  // where the runtime says it before a session runs
  std::vector<std::string> formats;  // of pictures that it takes, in its order
  std::vector<std::string> missing;  // optional extensions that it lacks, and what goes without them
};

// The connection to the runtime of a headset (OpenXR), found at run time. The Context is opened with it, since the
// runtime chooses the device. Must outlive the Headset; one thread.
class HeadsetRuntime {
 public:
  // DeviceMissing, in one line that says what to install or to start: no loader, no runtime, no headset, or a runtime
  // without XR_KHR_vulkan_enable2. `manifest`: the runtime's file, for that line; the loader finds it by itself.
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

// An eye of the wearer, in the room, when the frame is seen.
struct HeadsetEye {
  scene::HeadPose pose;
  scene::FieldOfView fov;
  scene::EyeView view;
};

// The controller that was used last, in the room.
struct HeadsetController {
  bool connected = false;
  bool place_valid = false;
  glm::dvec3 position_m{0.0};
  glm::dquat room_from_controller{1.0, 0.0, 0.0, 0.0};  // it points along its -z
  bool select = false, grab = false, scale = false, home = false;
  glm::dvec2 fly{0.0};  // of the stick: to the right, away
};

// Shows a renderer's eyes in a headset. Once a loop: next_turn(); for Turn::Frame then locate_eyes(),
// Renderer::render() with these eyes, and show(). A headset that is off, lost or frozen is a picture that nobody sees:
// the loop goes on, and a lost one is looked for every kLookAgainNs. One thread, but for the wait for the runtime's
// next frame, which has its own: a runtime may keep it waiting for as long as it likes.
class Headset {
 public:
  // `room_from_floor`: the floor's origin below the wearer, who looks along its -z. Failed or DeviceMissing: a runtime
  // that takes no picture of ours. All must outlive it; `context` was opened with `runtime`.
  static core::Result<std::unique_ptr<Headset>> create(HeadsetRuntime& runtime, Context& context, Renderer& renderer,
                                                       const scene::HeadPose& room_from_floor,
                                                       const core::Clock& clock);
  Headset(const Headset&) = delete;
  Headset& operator=(const Headset&) = delete;
  ~Headset();

  enum class Turn {
    Off,     // no session runs: the headset is not worn, or it is lost
    Frozen,  // the runtime has asked for no frame for kFrozenNs
    Hidden,  // it has asked for one, which nobody sees
    Frame
  };

  // Follows the runtime's events and waits for its next frame, calling `while_waiting` every few milliseconds, until
  // kFrozenNs after the wait began.
  Turn next_turn(const std::function<void()>& while_waiting);

  // The eyes when the frame of this turn is seen, as the runtime knows them after all that showing a picture waits for,
  // calling `while_waiting` every few milliseconds: called last, just before drawing. Empty while the runtime has lost
  // them or lends no image; the frame is then shown without a picture.
  std::optional<std::array<HeadsetEye, 2>> locate_eyes(const std::function<void()>& while_waiting);

  // How many panels the runtime can show itself, sharper than they are in the eyes' pictures: FrameState::panels_apart
  // of the frame that is shown. 0 where it has too few layers for them, or none that takes their bytes.
  std::size_t most_panels() const;

  // Shows the renderer's newest frame, drawn for the eyes that were located last, with its panels apart; waits for
  // nothing. False: nobody sees it, because there were no eyes, or the runtime is gone.
  bool show();

  // Of the newest frame that was shown: how old the eyes' place was when the runtime got the frame. None before the
  // first.
  std::optional<std::int64_t> pose_age_ns() const;

  // As of this turn; none where it brought no frame.
  const HeadsetController& controller() const;

  // A short push of the controller that was used last.
  void pulse();

  // What has happened, a line each, for the log.
  std::vector<std::string> take_messages();

  static constexpr std::int64_t kFrozenNs = 250'000'000;
  static constexpr std::int64_t kLookAgainNs = 2'000'000'000;

 private:
  struct Parts;
  explicit Headset(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

// Connects to the runtime and asks it all that it says without showing a picture. DeviceMissing as
// HeadsetRuntime::connect().
core::Result<HeadsetDescription> describe_headset(std::string manifest);

}  // namespace afm::render
