// SPDX-License-Identifier: Apache-2.0
#include "app/frame_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "physics/contact.h"
#include "physics/quantity_text.h"

namespace afm::app {

namespace {

using physics::format_quantity;

constexpr double kNmPerM = 1e9;
constexpr double kNnPerN = 1e9;

// Axes around the loop, in units of Z_joc and F_ad.
constexpr double kAxisBelow = 0.42, kAxisAbove = 1.42;
constexpr double kForceBelow = 1.22, kForceAbove = 0.52;

struct StateSign {
  const char* word;
  render::StateShape shape;
  glm::vec3 color;
};

StateSign sign_of(scene::ServoState state) {
  switch (state) {
    case scene::ServoState::Arming:
      return {"ARMING", render::StateShape::Triangle, {0.94F, 0.89F, 0.26F}};
    case scene::ServoState::Running:
      return {"FORCE ON", render::StateShape::Circle, {0.34F, 0.85F, 0.60F}};
    case scene::ServoState::Fading:
      return {"RELEASING", render::StateShape::Diamond, {0.90F, 0.62F, 0.0F}};
    case scene::ServoState::Fault:
      return {"FAULT", render::StateShape::Cross, {0.95F, 0.35F, 0.25F}};
    case scene::ServoState::Disarmed:
      break;
  }
  return {"FORCE OFF", render::StateShape::Square, {0.70F, 0.74F, 0.80F}};
}

// With a typographic minus, and no sign on what rounds to zero.
std::string signed_text(double value, int decimals, const char* unit) {
  const double tiny = 0.5 * std::pow(10.0, -decimals);
  const char* sign = value >= tiny ? "+" : value <= -tiny ? "\u2212" : "";
  return fmt::format("{}{:.{}f} {}", sign, std::abs(value), decimals, unit);
}

// "33.1 nm": how much one metre of the wall shows.
std::string scale_text(double m_per_m) {
  std::string text = format_quantity(physics::Length(m_per_m), physics::kLengthUnits, 3);
  if (const std::size_t micro = text.find("um"); micro != std::string::npos) text.replace(micro, 1, "\u00b5");
  return text;
}

}  // namespace

glm::vec3 curve_color(std::size_t material) {
  static constexpr std::array<glm::vec3, 7> kOkabeIto{{{0.34F, 0.71F, 0.91F},
                                                       {0.90F, 0.62F, 0.00F},
                                                       {0.00F, 0.78F, 0.56F},
                                                       {0.80F, 0.47F, 0.65F},
                                                       {0.94F, 0.89F, 0.26F},
                                                       {0.00F, 0.45F, 0.70F},
                                                       {0.84F, 0.37F, 0.00F}}};
  return kOkabeIto[material % kOkabeIto.size()];
}

core::Result<std::array<scene::EyeView, 2>> eyes_at_sweet_spot(const scene::Wall& wall) {
  std::array<scene::EyeView, 2> eyes;
  const scene::Viewer& viewer = wall.viewers.front();
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    const auto view = scene::off_axis_view(wall.screens.front(),
                                           scene::eye_position(viewer.sweet_spot, scene::kEyes[i], viewer.ipd_m),
                                           scene::DepthConvention::VulkanReversedInfinite, scene::kNearM, 0.0);
    if (!view) return tl::unexpected(view.error());
    eyes[i] = *view;
  }
  return eyes;
}

std::string stage_of_cycle(const Moment& moment, double z_jtc_m) {
  if (moment.phase == scene::ContactPhase::WaitForLift) return "lift the tip";
  if (moment.phase == scene::ContactPhase::Free) {
    if (moment.retracting) return "B \u2192 A   free again";
    return moment.tip.z_m < 2.0 * z_jtc_m ? "A \u2192 C   close to the jump" : "A \u2192 C   approach, no force";
  }
  if (!moment.retracting) return moment.tip.z_m > 0.0 ? "C \u2192 D   jump to contact" : "D \u2192 E   press";
  return moment.tip.z_m > 0.0 ? "E \u2192 F   adhesion pulls" : "E \u2192 F   retract";
}

FrameBuilder::FrameBuilder(const WallScene& wall_scene, const scene::MaterialLibrary& materials,
                           const std::array<scene::EyeView, 2>& eyes)
    : wall_scene_(&wall_scene), materials_(&materials), eyes_(eyes) {}

render::FrameState FrameBuilder::build(const Moment& moment) const {
  render::FrameState frame;
  frame.eyes = eyes_;
  wall_scene_->place({.material = moment.material,
                      .tip = moment.tip,
                      .hovered = moment.hovered,
                      .wand = moment.wand,
                      .instrument = moment.compare_all ? WallScene::Instrument::Hidden : WallScene::Instrument::Shown},
                     frame);
  frame.force_panel = force_panel(moment);
  frame.data_panel = data_panel(moment);
  frame.banner = banner(moment);
  return frame;
}

render::ForcePanel FrameBuilder::force_panel(const Moment& moment) const {
  render::ForcePanel panel;
  panel.title = "Force on the tip";
  double z_joc_nm = 1.0, f_ad_nn = 1.0;
  for (std::size_t i = 0; i < materials_->materials.size(); ++i) {
    const bool in_front = moment.compare_all || moment.material == i;
    const auto events = physics::approach_retract_events(materials_->materials[i].interaction);
    if (in_front) {
      z_joc_nm = std::max(moment.compare_all ? z_joc_nm : 0.0, events.z_joc.si * kNmPerM);
      f_ad_nn = std::max(moment.compare_all ? f_ad_nn : 0.0, events.f_ad.si * kNnPerN);
    }
    if (i >= moment.curves.size() || moment.curves[i].empty()) continue;
    render::PlotCurve curve = moment.curves[i].plot(materials_->materials[i].title, curve_color(i));
    curve.faded = !in_front;
    panel.curves.push_back(std::move(curve));
  }
  // earlier materials behind, the current one in front
  std::stable_partition(panel.curves.begin(), panel.curves.end(), [](const render::PlotCurve& c) { return c.faded; });
  panel.z_min_nm = -kAxisBelow * z_joc_nm;
  panel.z_max_nm = kAxisAbove * z_joc_nm;
  panel.force_min_nn = -kForceBelow * f_ad_nn;
  panel.force_max_nn = kForceAbove * f_ad_nn;
  if (moment.compare_all) {
    panel.title = "Approach and retract of all materials";
    panel.stage = "";
    return panel;
  }
  if (!moment.material) return panel;

  using Kind = render::PlotMarker::Kind;
  const auto events = physics::approach_retract_events(materials_->materials[*moment.material].interaction);
  const double z_jtc_nm = events.z_jtc.si * kNmPerM, f_attr_nn = events.f_attr.si * kNnPerN;
  panel.markers = {{Kind::VerticalLine, z_jtc_nm, fmt::format("Z_jtc {:.2f} nm", z_jtc_nm)},
                   {Kind::VerticalLine, z_joc_nm, fmt::format("Z_joc {:.2f} nm", z_joc_nm)},
                   {Kind::HorizontalLine, -f_attr_nn, fmt::format("F_attr {:.3f} nN", f_attr_nn)},
                   {Kind::HorizontalLine, -f_ad_nn, fmt::format("F_ad {:.3f} nN", f_ad_nn)}};
  panel.stage = stage_of_cycle(moment, events.z_jtc.si);
  if (moment.phase != scene::ContactPhase::WaitForLift) {
    panel.cursor = render::PlotPoint{moment.tip.z_m * kNmPerM, moment.force_n * kNnPerN};
  }
  return panel;
}

render::DataPanel FrameBuilder::data_panel(const Moment& moment) const {
  render::DataPanel panel;
  if (moment.compare_all) {
    panel.title = "What was felt";
    panel.subtitle = "jump to contact / jump off contact";
    for (const Felt& felt : moment.felt) {
      panel.rows.push_back({felt.title,
                            fmt::format("{:.3f} / {:.3f} nN", felt.f_attr_n * kNnPerN, felt.f_ad_n * kNnPerN),
                            fmt::format("at {:.2f} nm / {:.2f} nm", felt.z_jtc_m * kNmPerM, felt.z_joc_m * kNmPerM)});
    }
    return panel;
  }
  if (!moment.material) {
    panel.title = "No material yet";
    panel.subtitle = "point at a swatch and press";
    return panel;
  }
  const scene::MaterialEntry& material = materials_->materials[*moment.material];
  const physics::Interaction& in = material.interaction;
  const auto source = [&](std::string_view key) {
    const auto found =
        std::find_if(material.sources.begin(), material.sources.end(), [&](const auto& s) { return s.key == key; });
    return found == material.sources.end() ? std::string() : found->source;
  };
  panel.title = material.title;
  panel.subtitle = fmt::format("{} tip, in {}", material.tip, material.medium);
  panel.rows = {{"Tip radius R", format_quantity(in.tip_radius, physics::kLengthUnits, 3), source("tip_radius")},
                {"Spring constant k", fmt::format("{:g} N/m", in.spring_constant.si), source("spring_constant")},
                {"Hamaker constant A", format_quantity(in.hamaker, physics::kEnergyUnits, 3), source("hamaker")},
                {"Surface energy \u221a(\u03b3\u03b3)",
                 fmt::format("{:.3f} mJ/m\u00b2", in.mean_surface_energy.si * 1e3), source("mean_surface_energy")},
                {"Lever deflection", signed_text(moment.tip.deflection_m * kNmPerM, 2, "nm"), ""},
                {"Force on the tip", signed_text(moment.force_n * kNnPerN, 3, "nN"), ""}};
  return panel;
}

render::Banner FrameBuilder::banner(const Moment& moment) const {
  const StateSign sign = sign_of(moment.servo_state);
  render::Banner banner;
  banner.guidance = moment.guidance;
  banner.state_word = sign.word;
  banner.state_shape = sign.shape;
  banner.state_color = sign.color;
  if (!moment.realtime) banner.warning = "not real-time";
  const DrawnScale scale = wall_scene_->drawn_scale(moment.material.value_or(0));
  banner.scale = fmt::format(
      "sample and motion: 1 m = {}     lever: 1 m = {}     tip: 1 m = {}     deflection \u00d7{:.0f} against the lever",
      scale_text(scale.sample_m_per_m), scale_text(scale.lever_m_per_m), scale_text(scale.tip_m_per_m),
      scale.lever_m_per_m / scale.sample_m_per_m);
  return banner;
}

}  // namespace afm::app
