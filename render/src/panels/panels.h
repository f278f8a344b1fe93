// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <imgui.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/members.h"
#include "drawing/eye_targets.h"
#include "drawing/panel_sight.h"
#include "panels/grid_texture.h"
#include "panels/painted_shapes.h"
#include "panels/panel_brush.h"
#include "panels/panel_fonts.h"
#include "panels/panel_painting.h"
#include "panels/panel_part.h"
#include "panels/panel_texture.h"
#include "render/frame.h"
#include "render/renderer.h"

namespace afm::render {

inline constexpr std::size_t kFramesInFlight = 2;

// Contribution of one panel to the eyes' pictures.
struct PanelState {
  bool shown = false;
  PanelPlacement placement = kNoPlacement;
  std::uint64_t painting = 0;  // number of the painting that the texture shows
  PanelPart part{};            // part that differs from the previous painting

  bool operator==(const PanelState&) const = default;
};

// Panel that is left out of the eyes' pictures.
struct ApartPanel {
  std::size_t place = 0;  // index of this panel, the same in every frame
  PanelPlacement placement;
  vk::Image texture;  // valid until the next frame
  vk::Extent2D extent;
  std::uint64_t painting = 0;  // number as in PanelState::painting
};

// Panels of a frame. Each is painted into its texture, repainted only when its content or size changes, and shown on
// its rectangle in the room; the banner is drawn over everything. Panels without area are neither painted nor shown.
class Panels {
 public:
  // With Redraw::Everything, textures are repainted as a whole. The glyphs are drawn when a panel is first shown.
  Panels(const Device& device, FontFiles fonts, vk::DescriptorSetLayout frame_set_layout,
         const RendererOptions& options);
  ~Panels();

  // Stores a frame's panels; returns true if one of them must be repainted. `slot` is the frame in flight, whose
  // previous use is over.
  bool update(const FrameState& frame, std::size_t slot);

  // Call after update(): leaves up to `most` panels out of the eyes' pictures, those that nothing hides.
  void set_apart(std::size_t most, const PanelSight& sight);
  // Panels left out of the eyes' pictures, in drawing order. The frame's commands paint their textures.
  std::vector<ApartPanel> apart() const;

  // Paints the changes; call outside any rendering.
  void record_textures(const vk::raii::CommandBuffer& command, std::size_t slot);

  // Draws all panels except those apart, blended over the picture; call inside an eye pass. The recorded commands stay
  // valid until revision() changes.
  void record_rectangles(const vk::raii::CommandBuffer& command, const EyePassConfig& drawing,
                         vk::DescriptorSet frame_set);
  std::uint64_t revision() const { return revision_; }

  // Lists all panels as the eyes' pictures show them, each always at the same index; `states` keeps its memory.
  void list(std::vector<PanelState>& states) const;

 private:
  static constexpr std::size_t kSlots = core::kMembers<FramePanels>;

  struct Panel {
    PanelPlacement placement;
    PanelLayer layer = PanelLayer::InScene;
    PanelTexture texture;
    PaintedShapes shapes;           // shapes of the last painting
    glm::vec2 canvas_texels{1.0F};  // canvas size; a texture of the largest size shows it reduced
    std::uint64_t painting = 0;     // number of paintings so far
    PanelPart part;                 // part as in PanelState::part
    bool shown = false;
    bool apart = false;                  // true: left out of the eyes' pictures
    bool has_place = false;              // true: room available to show it apart
    std::optional<scene::Eye> only_eye;  // only eye that sees it; none: both
  };
  // Contents that the textures show.
  struct Contents {
    FramePanels panels;
    std::vector<Label> labels;
    std::array<EyeMark, 2> marks;
  };
  // Everything painted in one frame.
  struct Shapes {
    std::vector<ImDrawVert> vertices;
    std::vector<ImDrawIdx> indices;
    std::vector<ImDrawCmd> commands;
  };
  // Same data on the device.
  struct Geometry {
    Buffer vertices;
    Buffer indices;
    GridTexture grids;
  };
  struct Painting {
    const Panel* panel = nullptr;
    std::size_t first_vertex = 0;
    std::size_t first_index = 0;
    std::size_t first_command = 0;
    std::size_t command_count = 0;
    bool whole = true;  // true: all of the panel; false: only its part
  };

  PanelBrush& brush();  // creates the brush at the first call
  bool shows_any() const;
  template <class Content>
  void update(Panel& panel, const PanelPlacement& placement, const Content& content, Content& painted);
  enum class Texels { Kept, Fresh };
  template <class Content>
  void paint_on(Panel& panel, const Content& content, Texels texels);
  bool resize(Panel& panel);
  void record_painting(const vk::raii::CommandBuffer& command, const Geometry& geometry,
                       const Painting& painting) const;

  const Device& device_;
  RendererOptions options_;
  double largest_texture_;  // largest width and height of a texture
  FontFiles font_files_;    // contents of the fonts, empty once the glyphs are drawn
  vk::raii::DescriptorSetLayout texture_layout_;
  vk::raii::PipelineLayout canvas_layout_;
  vk::raii::PipelineLayout rectangle_layout_;
  EyePipeline rectangle_pipeline_;
  EyePipeline over_all_pipeline_;  // pipeline for the banner, which nothing covers
  vk::raii::Sampler sampler_;
  std::optional<PanelBrush> brush_;  // empty until a panel is shown
  std::array<Geometry, kFramesInFlight> geometry_;
  std::array<Panel, kSlots> slots_;  // in the order of FramePanels
  std::vector<Panel> labels_;
  std::array<Panel, 2> eye_marks_;
  Contents painted_;
  std::uint64_t revision_ = 0;
  std::vector<Panel*> order_, drawn_;  // used by set_apart(); kept to reuse their memory

  // possibly still in use by older frames; freed when the slot is used again
  std::array<std::vector<PanelTexture>, kFramesInFlight> retired_;
  std::size_t slot_ = 0;

  // content painted in this frame; kept to reuse its memory
  CanvasMemory memory_;
  std::vector<Painting> paintings_;
  PaintedShapes latest_;
  Shapes shapes_;
};

}  // namespace afm::render
