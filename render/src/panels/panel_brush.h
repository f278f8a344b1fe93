// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <imgui.h>

#include <memory>

#include "panels/panel_fonts.h"
#include "panels/panel_texture.h"

namespace afm::render {

// Format of the panels' textures, which hold premultiplied sRGB values.
inline constexpr vk::Format kPanelFormat = vk::Format::eR8G8B8A8Unorm;

// Objects shared by the painting of all panels. Created with the first panel that is shown, because
// its glyphs take longer than the rest of the start of a program that shows none. One thread.
class PanelBrush {
 public:
  struct Layouts {
    vk::DescriptorSetLayout texture;  // layout for create_panel_texture()
    vk::PipelineLayout canvas;
    vk::Sampler sampler;
  };
  // Uploads the glyphs and waits for it.
  PanelBrush(const Device& device, PanelFonts fonts, const Layouts& layouts);

  const PanelFonts& fonts() const { return fonts_; }
  // Makes its context the current one for Dear ImGui's functions.
  void take_up() const { ImGui::SetCurrentContext(imgui_.get()); }
  const vk::raii::Pipeline& canvas() const { return canvas_; }
  const vk::raii::Pipeline& grids() const { return grids_; }  // pipeline for the colour grids of a canvas
  vk::DescriptorSet glyphs() const { return *atlas_.set; }

 private:
  struct ContextDeleter {
    void operator()(ImGuiContext* context) const;
  };
  void upload_atlas(const Device& device, const Layouts& layouts);

  PanelFonts fonts_;
  std::unique_ptr<ImGuiContext, ContextDeleter> imgui_;
  vk::raii::Pipeline canvas_;
  vk::raii::Pipeline grids_;
  PanelTexture atlas_;
};

}  // namespace afm::render
