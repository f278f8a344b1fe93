// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <imgui.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/members.h"
#include "device/memory.h"
#include "panels/painted_shapes.h"
#include "panels/panel_fonts.h"
#include "panels/panel_painting.h"
#include "panels/panel_part.h"
#include "passes/eye_targets.h"
#include "passes/panel_sight.h"
#include "render/frame.h"
#include "render/renderer.h"

namespace afm::render {

inline constexpr std::size_t kFramesInFlight = 2;

// Of the panels' textures, which hold premultiplied sRGB values; and their use whenever they are not painted.
inline constexpr vk::Format kPanelFormat = vk::Format::eR8G8B8A8Unorm;
inline constexpr ImageUse kPanelShown{vk::PipelineStageFlagBits2::eFragmentShader,
                                      vk::AccessFlagBits2::eShaderSampledRead, vk::ImageLayout::eShaderReadOnlyOptimal};

// What one panel adds to the pictures of the eyes.
struct PanelState {
  bool shown = false;
  PanelPlacement placement = kNoPlacement;
  std::uint64_t painting = 0;  // which of its paintings the texture shows
  PanelPart part{};            // in which that differs from the one before it

  bool operator==(const PanelState&) const = default;
};

// A panel that is left out of the eyes' pictures.
struct ApartPanel {
  std::size_t place = 0;  // of this panel in every frame
  PanelPlacement placement;
  vk::Image texture;  // until the next frame
  vk::Extent2D extent;
  std::uint64_t painting = 0;  // as PanelState::painting
};

// The panels of a frame: each is painted into its texture, and again only when its content or size has changed, and
// shown on its rectangle in the room, the banner over all that is there. Panels without area are neither painted nor
// shown.
class Panels {
 public:
  // With Redraw::Everything textures are painted as a whole.
  Panels(const Device& device, PanelFonts fonts, vk::DescriptorSetLayout frame_set_layout,
         const RendererOptions& options);
  ~Panels();

  // Takes a frame's panels; whether one of them must be painted again. `slot` numbers the frame in flight, whose
  // previous use is over.
  bool update(const FrameState& frame, std::size_t slot);

  // After update(): leaves up to so many panels out of the eyes' pictures, those that nothing hides.
  void set_apart(std::size_t most, const PanelSight& sight);
  // These, in the order in which they cover each other. Their textures are painted in the frame's commands.
  std::vector<ApartPanel> apart() const;

  // Paints what has changed; outside any rendering.
  void record_textures(const vk::raii::CommandBuffer& command, std::size_t slot);

  // Shows all panels but those apart, blended over what is there; inside an eye pass. What it records stays right until
  // revision() changes.
  void record_rectangles(const vk::raii::CommandBuffer& command, const EyePassConfig& drawing,
                         vk::DescriptorSet frame_set);
  std::uint64_t revision() const { return revision_; }

  // All panels as the eyes' pictures show them now, each always at the same place; `states` keeps its memory.
  void list(std::vector<PanelState>& states) const;

 private:
  static constexpr std::size_t kSlots = core::kMembers<FramePanels>;

  struct ContextDeleter {
    void operator()(ImGuiContext* context) const;
  };
  struct Texture {
    DeviceImage image;
    vk::raii::ImageView view{nullptr};
    vk::raii::DescriptorPool pool{nullptr};  // of one set: panels come and go with the labels
    vk::raii::DescriptorSet set{nullptr};
  };
  struct Panel {
    PanelPlacement placement;
    PanelLayer layer = PanelLayer::InScene;
    Texture texture;
    PaintedShapes shapes;           // what has been painted
    glm::vec2 canvas_texels{1.0F};  // what is painted, which a texture of the largest size shows smaller
    std::uint64_t painting = 0;     // how many times it has been painted
    PanelPart part;                 // as PanelState::part
    bool shown = false;
    bool apart = false;                  // from the eyes' pictures
    bool has_place = false;              // there are enough places to show it apart
    std::optional<scene::Eye> only_eye;  // whose picture alone shows it
  };
  // Vertices and indices of everything painted in one frame.
  struct Geometry {
    Buffer vertices;
    Buffer indices;
  };
  struct Painting {
    const Panel* panel = nullptr;
    std::size_t first_vertex = 0;
    std::size_t first_index = 0;
    std::size_t first_command = 0;
    std::size_t command_count = 0;
    bool whole = true;  // or the panel's part alone
  };

  void upload_atlas();
  vk::raii::DescriptorPool create_pool() const;
  vk::raii::DescriptorSet create_set(const vk::raii::DescriptorPool& pool, vk::ImageView view) const;
  template <class Content>
  void update(Panel& panel, const PanelPlacement& placement, const Content& content, Content& painted);
  enum class Texels { Kept, Fresh };
  template <class Content>
  void paint_on(Panel& panel, const Content& content, Texels texels);
  bool resize(Panel& panel);
  Texture create_texture(vk::Extent2D extent) const;
  void record_painting(const vk::raii::CommandBuffer& command, const Geometry& geometry,
                       const Painting& painting) const;

  const Device& device_;
  Redraw redraw_;
  PanelContrast contrast_;
  double largest_texture_;  // texels each way
  PanelFonts fonts_;
  std::unique_ptr<ImGuiContext, ContextDeleter> imgui_;
  vk::raii::DescriptorSetLayout texture_layout_;
  vk::raii::PipelineLayout canvas_layout_;
  vk::raii::Pipeline canvas_pipeline_;
  vk::raii::PipelineLayout rectangle_layout_;
  EyePipeline rectangle_pipeline_;
  EyePipeline over_all_pipeline_;  // of the banner, which nothing covers
  vk::raii::Sampler sampler_;
  DeviceImage atlas_;
  vk::raii::ImageView atlas_view_{nullptr};
  vk::raii::DescriptorPool atlas_pool_{nullptr};
  vk::raii::DescriptorSet atlas_set_{nullptr};
  std::array<Geometry, kFramesInFlight> geometry_;
  std::array<Panel, kSlots> slots_;  // in the order of FramePanels
  std::vector<Panel> labels_;
  std::array<Panel, 2> eye_marks_;
  // what the textures of these show
  FramePanels painted_;
  std::vector<Label> painted_labels_;
  std::array<EyeMark, 2> painted_marks_;
  std::uint64_t revision_ = 0;
  std::vector<Panel*> order_, drawn_;  // of set_apart(); kept to reuse their memory

  // what the frames before the slot's may still show: freed when the slot comes round again
  std::array<std::vector<Texture>, kFramesInFlight> retired_;
  std::size_t slot_ = 0;

  // what this frame paints; kept to reuse its memory
  CanvasMemory memory_;
  std::vector<Painting> paintings_;
  PaintedShapes shapes_;
  std::vector<ImDrawVert> vertices_;
  std::vector<ImDrawIdx> indices_;
  std::vector<ImDrawCmd> commands_;
};

}  // namespace afm::render
