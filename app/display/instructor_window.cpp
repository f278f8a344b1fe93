// SPDX-License-Identifier: Apache-2.0
#include "app/display/instructor_window.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <utility>

#include "app/display/view_outputs.h"
#include "core/log.h"
#include "exhibit/lesson/instructor_page.h"
#include "exhibit/words/phrases.h"
#include "scene/graph/scene.h"

namespace afm::app {

namespace {

constexpr const char* kInstructorTitle = "TouchAFM, instructor";
constexpr glm::uvec2 kFreeSizePx{960, 600};
constexpr std::int64_t kAnewNs = 1'000'000'000;

double shape_of(glm::uvec2 size_px) { return static_cast<double>(size_px.x) / static_cast<double>(size_px.y); }

}  // namespace

core::Result<render::Window> InstructorWindow::open_window(const std::string& place,
                                                           const std::vector<render::Monitor>& monitors) {
  render::WindowOptions options{.title = kInstructorTitle, .width = kFreeSizePx.x, .height = kFreeSizePx.y};
  if (place != kFree) {
    auto filled = fill_monitor("--instructor", place, monitors, options);
    if (!filled) return tl::unexpected(filled.error());
  }
  return render::Window::open(options);
}

core::Result<std::unique_ptr<InstructorWindow>> InstructorWindow::create(render::Context& context,
                                                                         render::Window& window,
                                                                         const exhibit::Phrases& phrases,
                                                                         render::PanelContrast contrast) {
  const glm::uvec2 size_px = glm::max(window.size_px(), glm::uvec2(1));
  render::RendererOptions drawing{.eye_width = size_px.x, .eye_height = size_px.y, .samples = 1};
  drawing.panel_texels_per_m = 2.0 * size_px.y / exhibit::InstructorPage::kHeightM;
  drawing.panel_contrast = contrast;
  auto renderer = render::Renderer::create(context, scene::Scene{}, drawing);
  if (!renderer) return tl::unexpected(renderer.error());
  const std::array<render::Window*, 1> windows{&window};
  auto presenter = render::Presenter::create(context, *renderer, windows);
  if (!presenter) return tl::unexpected(presenter.error());
  core::log_line("the instructor's window is open: keys 1 to 4, or a click");
  return std::unique_ptr<InstructorWindow>(
      new InstructorWindow(window, phrases, std::move(*renderer), std::move(*presenter), size_px));
}

InstructorWindow::InstructorWindow(render::Window& window, const exhibit::Phrases& phrases, render::Renderer renderer,
                                   render::Presenter presenter, glm::uvec2 size_px)
    : window_(window),
      phrases_(phrases),
      renderer_(std::move(renderer)),
      presenter_(std::move(presenter)),
      size_px_(size_px),
      page_(std::make_unique<exhibit::InstructorPage>(shape_of(size_px))) {}

InstructorWindow::~InstructorWindow() = default;

InstructorWindow::Input InstructorWindow::poll(const exhibit::LessonPrompt& prompt) {
  render::WindowInput input = window_.poll();
  Input result{.actions = {}, .keys = {}, .close_requested = input.close_requested};
  pointed_ = page_->action_at(input.cursor_px / glm::dvec2(size_px_), prompt);
  for (const render::WindowEvent& event : input.events) {
    using Kind = render::WindowEvent::Kind;
    if (event.kind == Kind::ButtonDown && event.button == render::MouseButton::Left) {
      const auto pressed = page_->action_at(event.cursor_px / glm::dvec2(size_px_), prompt);
      if (pressed) result.actions.push_back(*pressed);
    }
    if (event.kind != Kind::KeyDown) continue;
    const auto number = static_cast<std::size_t>(event.key) - static_cast<std::size_t>(render::Key::Digit1);
    if (event.key < render::Key::Digit1 || event.key > render::Key::Digit9) {
      result.keys.push_back(event.key);
    } else if (number < exhibit::kInstructorActions) {
      const exhibit::InstructorAction action = core::kEnumerators<exhibit::InstructorAction>[number];
      if (acts(action, prompt)) result.actions.push_back(action);
    }
  }
  return result;
}

// Gives the page the window's proportions.
void InstructorWindow::follow_size() {
  const glm::uvec2 size_px = window_.size_px();
  if (size_px == size_px_ || size_px.x == 0 || size_px.y == 0) return;
  if (auto resized = renderer_.resize(size_px.x, size_px.y); !resized) return core::log_line(resized.error().message);
  size_px_ = size_px;
  *page_ = exhibit::InstructorPage(shape_of(size_px));
  shown_.reset();
}

void InstructorWindow::show(const exhibit::InstructorState& state, std::int64_t now_ns,
                            const std::function<void()>& while_waiting) {
  follow_size();
  const render::FrameState frame = page_->frame(state, pointed_, phrases_);
  const bool same = shown_ == frame.panels.data.content && shown_labels_ == frame.labels;
  if (same && now_ns - shown_ns_ < kAnewNs) return;
  const std::array<render::WindowPicture, 1> pictures{{{.composition = {.mode = scene::StereoMode::Mono}}}};
  if (!presenter_.begin(pictures, while_waiting)) return;
  renderer_.render(frame);
  while_waiting();
  presenter_.draw(std::array<std::size_t, 1>{0}, while_waiting);
  presenter_.show();
  shown_ = frame.panels.data.content;
  shown_labels_ = frame.labels;
  shown_ns_ = now_ns;
}

}  // namespace afm::app
