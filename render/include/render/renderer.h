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
// Automatic: one pass unless the device lacks it or would draw that frame wrongly. Where both eyes see the same, one is
// drawn.
enum class PassMode { Automatic, Multiview, TwoPasses };

// What a frame draws of the pictures of the eyes: what has changed in them since the last one, or always everything,
// with identical results: to measure, and to check the former.
enum class Redraw { Changes, Everything };

// Light ink on a dark plate that lets the scene shine through a little; the same on an opaque one, where light is mixed
// as light and bright things would shine through more; or white on an opaque black one.
enum class PanelContrast { Normal, Opaque, High };

struct RendererOptions {
  std::uint32_t eye_width = 960;
  std::uint32_t eye_height = 720;
  std::uint32_t samples = 4;  // 1 or 4
  PassMode pass_mode = PassMode::Automatic;
  Redraw redraw = Redraw::Changes;
  // Resolution of the panels' textures. Text is sharpest at twice the eye image's pixels per metre of wall: then each
  // pixel's bilinear sample covers just the texels below it.
  double panel_texels_per_m = 640.0;
  // Size of a panel's millimetre. Panel texts have their sizes for the paper's wall; a smaller wall has a smaller
  // millimetre.
  double panel_millimetre_m = 1e-3;
  PanelContrast panel_contrast = PanelContrast::Normal;
  bool time_passes = false;  // for pass_times()
};

// Resolution and samples of a frame; its contents and layout do not depend on it.
struct FrameQuality {
  double scale = 1.0;         // of the eye images' resolution each way: (0, 1]; what is shown is scaled back up
  std::uint32_t samples = 4;  // 1 or 4, no more than the renderer was made for

  bool operator==(const FrameQuality&) const = default;
};

// Device times of the parts of a frame; 0 where it did not need them.
struct PassTimes {
  double panels_ms = 0;  // painting those that have changed
  double shadow_ms = 0;
  double eyes_ms = 0;      // both, with the panels in the room
  double compose_ms = 0;   // of the newest frame that was shown in a window or saved
  double readback_ms = 0;  // of the newest one that was saved

  // Time of the whole frame.
  double total_ms() const { return panels_ms + shadow_ms + eyes_ms + compose_ms; }
};

// Draws frames of one Scene, which it uploads when it is made; of each what differs from the last one. Two frames are
// in flight: render() returns once a frame is submitted and waits only for the frame before the previous one. Nothing
// is read back unless asked for. One thread. A lost device and a lack of memory are exceptions: DeviceFailure.
class Renderer {
 public:
  // Failed: no font for the panels, sizes or samples that this device cannot do, or no memory for them. `context` must
  // outlive the renderer; `scene` is not kept.
  static core::Result<Renderer> create(Context& context, const scene::Scene& scene, const RendererOptions& options);

  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  // `frame.room_from_node` and, unless empty, `frame.visible` have one entry per node of the scene. Does nothing where
  // the frame looks as the last one.
  void render(const FrameState& frame);

  // Waits until render() has no earlier frame to wait for, and calls `while_waiting` meanwhile. Ends the process when
  // the device does not finish that frame within two minutes.
  void wait_until_ready(const std::function<void()>& while_waiting);

  // The newest frame; waits for it. At least one frame has been rendered. Of an eye what is drawn: less than
  // `eye_width` with a scale below 1.
  Image read_eye(scene::Eye eye);
  // Of a mode with one picture; as large as the device's images can be at most.
  Image read_composed(const Composition& composition, const ReadArea& area = {});
  // Of a mode with two: the left eye's place and the right eye's.
  std::array<Image, 2> read_pair(const Composition& composition, const ReadArea& area = {});

  // Eye images of another size from the next frame on; waits until the device is idle. The panels keep their
  // resolution. Failed, with nothing changed: a size that this device cannot do, or has no memory for.
  core::Result<void> resize(std::uint32_t eye_width, std::uint32_t eye_height);

  // From the next frame on: neither waits nor makes the eye images anew. At first: full resolution, all samples.
  void set_quality(const FrameQuality& quality);
  FrameQuality quality() const;

  // Of the newest frame that is finished. Nothing without RendererOptions::time_passes, or where the device has no
  // clock.
  std::optional<PassTimes> pass_times() const;

  // Share of the eyes' pixels that the newest frame drew; 0 where it looks as the one before it.
  double redrawn_share() const;

  // Waits until everything submitted is done: for measuring, and before a pause.
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
