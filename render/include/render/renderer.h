// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "core/result.h"
#include "render/composition.h"
#include "render/context.h"
#include "render/frame.h"
#include "scene/display/wall.h"
#include "scene/graph/scene.h"

namespace afm::render {

// Passes for the two eyes: one multiview pass, which some devices lack, or one pass per eye, with identical results.
// Automatic uses one pass unless the device lacks multiview or would draw that frame wrongly. Identical eyes are drawn
// once.
enum class PassMode { Automatic, Multiview, TwoPasses };

// Part of the eyes' pictures that a frame draws: the changes since the last frame, or everything, with identical
// results. Everything is for measurements and for checking Changes.
enum class Redraw { Changes, Everything };

// The key light with its shadow and the studio around it; or, for comparison with programs that have no more, the key
// light and an even light from all sides before a plain background, without shadows.
enum class Lighting { Studio, KeyAlone };

// Light ink on a dark plate that lets the scene shine through a little; the same on an opaque plate, where light is
// blended linearly and bright objects would shine through more; or white on opaque black.
enum class PanelContrast { Normal, Opaque, High };

struct RendererOptions {
  std::uint32_t eye_width = 960;
  std::uint32_t eye_height = 720;
  std::uint32_t samples = 4;  // 1 or 4
  PassMode pass_mode = PassMode::Automatic;
  Redraw redraw = Redraw::Changes;
  // Resolution of the panels' textures. Text is sharpest at twice the eye image's pixels per metre of wall: each
  // pixel's bilinear sample then covers just the texels below it.
  double panel_texels_per_m = 640.0;
  // Size of a panel's millimetre. Panel texts are sized for the paper's wall; a smaller wall has a smaller millimetre.
  double panel_millimetre_m = 1e-3;
  PanelContrast panel_contrast = PanelContrast::Normal;
  Lighting lighting = Lighting::Studio;
  bool time_passes = false;  // true: pass_times() available
};

// Device times of the parts of a frame; 0 for parts it did not need.
struct PassTimes {
  double panels_ms = 0;  // repainting changed panels
  double shadow_ms = 0;
  double eyes_ms = 0;      // both eyes, with the panels in the room
  double compose_ms = 0;   // composing the newest frame for a window or a file
  double readback_ms = 0;  // reading the newest frame back for a file

  // Time of the whole frame.
  double total_ms() const { return panels_ms + shadow_ms + eyes_ms + compose_ms; }
};

// Draws frames of one Scene, which it uploads on creation; each frame draws only what differs from the last. Two frames
// are in flight: render() returns once a frame is submitted and waits only for the frame before the previous one.
// Nothing is read back unless requested. One thread. Throws DeviceFailure if the device is lost or memory runs out.
class Renderer {
 public:
  // Failed: no font for the panels, sizes or samples that this device does not support, or too little memory. `context`
  // must outlive the renderer; `scene` is not kept.
  static core::Result<Renderer> create(Context& context, const scene::Scene& scene, const RendererOptions& options);

  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  // `frame.room_from_node` and, unless empty, `frame.visible` have one entry per node of the scene. Does nothing if the
  // frame looks like the last one.
  void render(const FrameState& frame);

  // Waits until render() has no earlier frame to wait for, calling `while_waiting` meanwhile. Ends the process if the
  // device does not finish that frame within two minutes.
  void wait_until_ready(const std::function<void()>& while_waiting);

  // Reads the newest frame, after waiting for it; at least one frame must have been rendered.
  Image read_eye(scene::Eye eye);
  // Composes the newest frame in a mode with one picture; at most as large as the device's images.
  Image read_composed(const Composition& composition, const ReadArea& area = {});
  // Same for a mode with two pictures, the left eye's and the right eye's.
  std::array<Image, 2> read_pair(const Composition& composition, const ReadArea& area = {});

  // Resizes the eye images from the next frame on, after waiting until the device is idle. The panels keep their
  // resolution. Failed, with nothing changed: this device does not support the size, or lacks memory for it.
  core::Result<void> resize(std::uint32_t eye_width, std::uint32_t eye_height);

  // Takes effect with the next frame; neither waits nor recreates the eye images. Initially full resolution and all
  // samples.
  void set_quality(const FrameQuality& quality);
  FrameQuality quality() const;

  // Times of the newest finished frame. Nothing without RendererOptions::time_passes, or if the device has no clock.
  std::optional<PassTimes> pass_times() const;

  // Fraction of the eyes' pixels that the newest frame drew; 0 if it looks like the one before.
  double redrawn_share() const;

  // Waits until all submitted work is done: before measurements and before a pause.
  void wait();

 private:
  friend class DepthMeter;
  friend class Headset;
  friend class ScreenshotQueue;
  friend class Presenter;
  struct Parts;
  explicit Renderer(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace afm::render
