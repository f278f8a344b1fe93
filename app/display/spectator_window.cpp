// SPDX-License-Identifier: Apache-2.0
#include "app/display/spectator_window.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "app/display/view_display.h"
#include "core/clock.h"
#include "curves/sample_model.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/frame_builder.h"
#include "exhibit/scan/served_image.h"

namespace afm::app {

namespace {

constexpr std::int64_t kFrameNs = 33'000'000;  // half of a display's rate, which leaves the processor to the instrument

}  // namespace

SpectatorWindow::SpectatorWindow(const exhibit::Stage& stage, std::vector<curves::SampleModel> materials,
                                 ViewDisplay& display, instrument::Showcase& showcase, const core::Clock& clock)
    : stage_(stage),
      materials_(std::move(materials)),
      display_(display),
      showcase_(showcase),
      clock_(clock),
      frames_(std::make_unique<exhibit::FrameBuilder>(stage.wall_scene, materials_, stage.eyes)) {}

SpectatorWindow::~SpectatorWindow() = default;

bool SpectatorWindow::leaves() {
  const ViewInput input = display_.windows().poll();
  bool leaves = input.close_requested;
  for (const ViewEvent& event : input.events) {
    if (event.event.kind != render::WindowEvent::Kind::KeyDown) continue;
    leaves = leaves || event.event.key == render::Key::Escape;
    if (event.event.key == render::Key::F11) display_.windows().toggle_full_screen();
    if (event.event.key == render::Key::F12) display_.picture().save();
  }
  return leaves;
}

std::optional<std::size_t> SpectatorWindow::place_of(const std::string& material) const {
  const auto& known = stage_.materials.materials;
  const auto found = std::find_if(known.begin(), known.end(),
                                  [&](const scene::MaterialEntry& entry) { return entry.name == material; });
  if (found == known.end()) return std::nullopt;
  return static_cast<std::size_t>(found - known.begin());
}

// The numbers of the contact now, as the panels show them; false: the wall lacks its material.
bool SpectatorWindow::follow_contact() {
  if (shown_.setup == followed_ || !shown_.setup) return true;
  const std::optional<std::size_t> place = place_of(shown_.setup->material.name);
  if (!place) return false;
  const std::size_t index = *place;
  if (auto model = curves::make_sample_model(*shown_.setup)) {
    stage_.wall_scene.lay_surface_on(model->parameters, index);
    materials_[index] = std::move(*model);
  }
  if (material_ != index) player_ = {};
  material_ = index;
  followed_ = shown_.setup;
  return true;
}

// Takes the newest state. False: the wall lacks the material. A curve begins only after its contact is known.
bool SpectatorWindow::take(double frame_s) {
  shown_ = showcase_.look([this](const std::string& material) { return place_of(material).has_value(); });
  if (!follow_contact()) return false;
  player_.advance(frame_s);
  if (!player_.playing() && shown_.curves != played_) {
    played_ = shown_.curves;
    player_.begin(shown_.curve);
  }
  if (shown_.image.number != image_number_) {
    image_number_ = shown_.image.number;
    line_ = {};
    image_ =
        std::make_unique<exhibit::ServedImage>(exhibit::ServedImage::Size{.columns = shown_.image.columns,
                                                                          .rows = shown_.image.rows,
                                                                          .width_m = shown_.image.width_m,
                                                                          .height_m = shown_.image.height_m,
                                                                          .line_rate_hz = shown_.image.line_rate_hz});
  }
  line_.advance(frame_s);
  take_lines();
  // the newest thing that happened is in front
  const bool newer = played_ > shown_.image.curves;
  if (player_.playing() && newer && !shown_.image.running && shown_.lines.empty()) image_.reset();
  return true;
}

void SpectatorWindow::take_lines() {
  if (!image_ || shown_.lines.empty()) return;
  for (const physics::ScanLine& line : shown_.lines) image_->add(line);
  if (!line_.playing()) line_.begin(shown_.lines.back());
}

// Places the tip on the displayed line, otherwise at the instrument's position.
void SpectatorWindow::put_tip(exhibit::WallState& wall) const {
  const scene::TopographyScale scale = stage_.wall_scene.topography_scale(material_.value_or(0));
  const double stiffness_n_per_m = materials_[material_.value_or(0)].parameters.contact.spring_constant.si;
  const double apex_m = shown_.z_m + shown_.force_n / stiffness_n_per_m;
  double x_m = shown_.x_m, y_m = shown_.y_m, surface_m = shown_.surface_m, force_n = shown_.force_n;
  if (image_ && line_.playing()) {
    const instrument::Shown::Image& image = shown_.image;
    const exhibit::LinePlayer::Place at = line_.place();
    const double right_m = (at.along - 0.5) * image.width_m;
    const double up_m =
        (0.5 - (static_cast<double>(line_.row()) + 0.5) / static_cast<double>(image.rows)) * image.height_m;
    const double cosine = std::cos(image.turn_rad), sine = std::sin(image.turn_rad);
    x_m += cosine * right_m - sine * up_m;
    y_m += sine * right_m + cosine * up_m;
    surface_m = at.height_m;
    force_n += at.error_n;
  }
  const double bend_m = force_n / stiffness_n_per_m;
  wall.surface = {.xy_m = {scale.lateral * x_m, scale.lateral * y_m}, .height_m = scale.vertical * surface_m};
  wall.tip = {.z_m = apex_m - bend_m, .force_n = force_n, .height_m = apex_m, .deflection_m = -bend_m};
}

void SpectatorWindow::draw() {
  exhibit::Moment now;
  now.wall.material = material_;
  put_tip(now.wall);
  if (material_) now.wall.release_z_m = materials_[*material_].figures().z_joc.si;
  now.realtime = true;  // simulated time, which is never late
  now.phase = shown_.touching ? physics::Phase::Attached : physics::Phase::Free;
  if (player_.playing()) {
    now.wall.tip = player_.tip();
    now.phase = player_.phase();
    now.retracting = player_.retracting();
  }
  std::vector<exhibit::CycleCurve> curves(materials_.size());
  if (material_) curves[*material_] = player_.drawn();
  now.curves = curves;
  now.wall.scan = image_ != nullptr;
  now.guidance = stage_.phrases()[exhibit::Phrase::Served];
  render::FrameState frame = frames_->build(now);
  if (image_ && material_) {
    const std::string& title = materials_[*material_].setup.material.title;
    frame.panels.image.content = image_->panel(stage_.phrases().word(title), stage_.phrases());
  }
  display_.picture().show(frame, exhibit::Relief::NarrowEyes, clock_.now_ns(), [] {});
}

std::optional<std::string> SpectatorWindow::run(const std::function<bool()>& over) {
  std::int64_t shown_ns = clock_.now_ns();
  while (!over() && !leaves()) {
    const std::int64_t now_ns = clock_.now_ns();
    const double frame_s = static_cast<double>(now_ns - std::exchange(shown_ns, now_ns)) * 1e-9;
    if (!take(frame_s)) return shown_.setup->material.name;
    if (display_.windows().hidden()) {
      display_.picture().rest();
    } else {
      display_.picture().fit(now_ns);
      draw();
    }
    const std::int64_t left_ns = now_ns + kFrameNs - clock_.now_ns();
    if (left_ns > 0) std::this_thread::sleep_for(std::chrono::nanoseconds(left_ns));
  }
  display_.picture().finish();
  return std::nullopt;
}

}  // namespace afm::app
