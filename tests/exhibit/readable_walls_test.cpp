// SPDX-License-Identifier: Apache-2.0
// What is painted on the panels of every wall, as Dear ImGui is given it: no word leaves its panel or is cut, and the
// servo's state is large enough on the smallest picture.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/bench/render_subjects.h"
#include "exhibit/exhibit_setup.h"
#include "exhibit/guidance.h"
#include "panels/panel_painting.h"
#include "places.h"

namespace afm::exhibit {
namespace {

constexpr std::uint32_t kLargestImage = 16384;
constexpr float kLeastLetterPx = 9.0F;   // em square of the state's word, in pixels of an eye
constexpr double kLeastBannerPx = 12.0;  // of its height: below it nothing can be read
constexpr std::array kWidthsPx{400U, 1280U, 2110U, 3840U, 7680U};
constexpr std::array kPresets{"powerwall", "two-projectors", "3d-tv", "desk-red-cyan", "tiled-2x2",
                              "cave",      "floor",          "wide",  "phone"};

struct ContextEnd {
  void operator()(ImGuiContext* context) const { ImGui::DestroyContext(context); }
};

// What one panel is made of, in texels of a picture with two for each pixel.
struct Painted {
  ImVec2 low{1e9F, 1e9F}, high{-1e9F, -1e9F};
  glm::vec2 size{0.0F};
  bool cut = false;              // there is an ellipsis
  float state_height_px = 0.0F;  // of the plate around the state's word

  bool inside() const { return low.x >= -1.0F && low.y >= -1.0F && high.x <= size.x + 1.0F && high.y <= size.y + 1.0F; }
};

class Painter {
 public:
  Painter(double texels_per_m, double millimetre_m)
      : fonts_(render::load_panel_fonts(texels_per_m, millimetre_m, kLargestImage).value()),
        millimetre_m_(millimetre_m),
        imgui_(ImGui::CreateContext(fonts_.atlas.get())) {
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    fonts_.atlas->GetTexDataAsAlpha8(&pixels, &width, &height);
    ImGui::GetIO().IniFilename = nullptr;
  }

  template <class Content>
  Painted paint(const Content& content, const render::PanelPlacement& placement, const glm::vec3& state_color = {}) {
    Painted painted;
    const glm::vec2 size_mm(glm::length(placement.right_m) / millimetre_m_,
                            glm::length(placement.up_m) / millimetre_m_);
    painted.size = size_mm * fonts_.texels_per_mm;
    ImGui::GetIO().DisplaySize = {painted.size.x, painted.size.y};
    ImGui::NewFrame();
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    render::Canvas canvas(list, fonts_, memory_, size_mm);
    render::paint(canvas, content);
    float top = 1e9F, bottom = -1e9F;
    for (const ImDrawVert& vertex : list.VtxBuffer) {
      painted.low = {std::min(painted.low.x, vertex.pos.x), std::min(painted.low.y, vertex.pos.y)};
      painted.high = {std::max(painted.high.x, vertex.pos.x), std::max(painted.high.y, vertex.pos.y)};
      painted.cut = painted.cut || is_ellipsis(vertex.uv);
      const ImVec4 color = ImGui::ColorConvertU32ToFloat4(vertex.col);
      if (glm::distance(glm::vec3(color.x, color.y, color.z), state_color) > 0.01F) continue;
      top = std::min(top, vertex.pos.y);
      bottom = std::max(bottom, vertex.pos.y);
    }
    painted.state_height_px = 0.5F * (bottom - top);
    ImGui::Render();
    return painted;
  }

 private:
  bool is_ellipsis(const ImVec2& uv) const {
    constexpr ImWchar kEllipsis = 0x2026;
    return std::any_of(fonts_.fonts.begin(), fonts_.fonts.end(), [&](ImFont* font) {
      const ImFontGlyph* const glyph = font->FindGlyphNoFallback(kEllipsis);
      return glyph != nullptr && uv.x == glyph->U0 && uv.y == glyph->V0;
    });
  }

  render::PanelFonts fonts_;
  double millimetre_m_;
  std::unique_ptr<ImGuiContext, ContextEnd> imgui_;
  render::CanvasMemory memory_;
};

// The longest that the banner has to show in the live window.
render::Banner full_banner(const Stage& stage, render::Banner banner) {
  banner.guidance = stage.guidance.text(Hint::LetGo, {.hand = HandControls::Mouse, .pointer = Pointer::Mouse});
  banner.state_word = "FORCE OFF";
  banner.state_color = {0.70F, 0.74F, 0.81F};
  banner.warning = "not real-time";
  banner.scale +=
      "\nScale of the hand: 0.708 mm/nm, 0.15 N/nN (fit: each sample fills the hand's stroke and force)     Force at "
      "most: "
      "2 N, 20 N/s (simulated hand)     Servo: 1000 Hz, not real-time (wakes late by p99 1000 \u00b5s, 12 of 61234 "
      "ticks "
      "missed)";
  return banner;
}

TEST(ReadableWalls, CutNoWordAndShowTheStateOnPicturesOfEverySize) {
  for (const char* preset : kPresets) {
    ExhibitFiles files;
    files.assets_dir = AFM_SOURCE_DIR "/assets";
    files.wall = fmt::format("{}/walls/{}.toml", files.assets_dir, preset);
    const auto stage = load_exhibit(files);
    ASSERT_TRUE(stage) << stage.error().message;
    const render::FrameState frame = app::wall_subject(*stage, 64).value().frames.back();
    for (const std::uint32_t width_px : kWidthsPx) {
      const std::string where = fmt::format("{} at {} pixels", preset, width_px);
      Painter painter(2.0 * width_px / stage->screen.width_m(), stage->wall_scene.panel_millimetre_m());
      const render::Banner shown = full_banner(*stage, frame.banner);
      const Painted banner = painter.paint(shown, frame.banner_placement, shown.state_color);
      const Painted force = painter.paint(frame.force_panel, frame.force_placement);
      const Painted data = painter.paint(frame.data_panel, frame.data_placement);
      EXPECT_TRUE(banner.inside()) << where << ": the banner";
      EXPECT_TRUE(force.inside()) << where << ": the plot";
      EXPECT_TRUE(data.inside()) << where << ": the data";
      EXPECT_FALSE(banner.cut || force.cut || data.cut) << where << (banner.cut ? ": the banner" : ": a panel");
      const float letters = render::text_height_mm(render::TextStyle::Strong);
      const float letter_px = banner.state_height_px * letters / (letters + 24.0F);
      // a picture of 12 m x 2 m that is 400 pixels wide has 67 rows, 7 of them for the banner
      if (glm::length(frame.banner_placement.up_m) * width_px / stage->screen.width_m() > kLeastBannerPx) {
        EXPECT_GE(letter_px, kLeastLetterPx) << where;
      }
      for (const render::Label& label : frame.labels) {
        EXPECT_TRUE(painter.paint(label, label.placement).inside()) << where << ": " << label.text;
      }
    }
  }
}

}  // namespace
}  // namespace afm::exhibit
