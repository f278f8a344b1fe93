// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "core/result.h"
#include "render/context.h"
#include "render/frame.h"
#include "scene/scene.h"
#include "scene/wall.h"

namespace afm::render {

// Both eyes in one multiview pass, or one pass an eye into images of its own: the oracle that the tests compare with.
enum class PassMode { Multiview, TwoPasses };

// How the two eye images become one picture. SideBySide is twice as wide as an eye, left eye left, no pixel scaled.
enum class Layout { Left, Right, SideBySide };

struct RendererOptions {
  std::uint32_t eye_width = 960;
  std::uint32_t eye_height = 720;
  std::uint32_t samples = 4;  // 1 or 4
  PassMode pass_mode = PassMode::Multiview;
  // Resolution of the panels' textures. Text is sharpest at twice the eye image's pixels per metre of wall: then each
  // pixel's bilinear sample covers just the texels below it.
  double panel_texels_per_m = 640.0;
};

// Draws frames of one Scene, which it uploads when it is made. Two frames are in flight: render() returns once a frame
// is submitted and waits only for the frame before the previous one. Nothing is read back unless asked for. One thread.
// Vulkan's own failures (device lost, out of memory) are exceptions derived from std::system_error.
class Renderer {
 public:
  // Failed: no font for the panels, or sizes or samples that this device cannot do. `context` must outlive the
  // renderer; `scene` is not kept.
  static core::Result<Renderer> create(Context& context, const scene::Scene& scene, const RendererOptions& options);

  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  // `frame.room_from_node` and, unless empty, `frame.visible` have one entry per node of the scene.
  void render(const FrameState& frame);

  // Whether render() would return without waiting for an earlier frame. Does not wait.
  bool ready() const;

  // The newest frame; waits for it. At least one frame has been rendered.
  Image read_eye(scene::Eye eye);
  Image read_composed(Layout layout);

  // Eye images of another size from the next frame on; waits until the device is idle. The panels keep their
  // resolution. Failed, with nothing changed: a size that this device cannot do.
  core::Result<void> resize(std::uint32_t eye_width, std::uint32_t eye_height);

  // Waits until everything submitted is done: for measuring, and before a pause.
  void wait();

 private:
  friend class Presenter;
  struct Parts;
  explicit Renderer(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace afm::render
