// SPDX-License-Identifier: Apache-2.0
#include "app/demo_figures.h"

#include <algorithm>

#include "app/demonstration.h"
#include "core/check.h"
#include "render/image_file.h"

namespace afm::app {

namespace {

constexpr std::int64_t kAfterJumpInNs = 5'000'000;
constexpr std::int64_t kBeforeJumpOffNs = 1'000'000;
constexpr std::int64_t kAfterJumpOffNs = 400'000'000;

}  // namespace

FigurePlan::FigurePlan(const std::vector<RecordedSession>& sessions, const std::vector<Measurement>& measurements,
                       std::size_t shown_material) {
  const RecordedSession& shown = sessions.at(shown_material);
  const scene::TipEvent* in = shown.find(scene::TipEventKind::JumpToContact);
  const scene::TipEvent* out = shown.find(scene::TipEventKind::JumpOffContact);
  AFM_CHECK(in != nullptr && out != nullptr);
  const auto deepest = std::min_element(shown.samples.begin(), shown.samples.end(),
                                        [](const auto& a, const auto& b) { return a.z_m < b.z_m; });

  struct Plan {
    const char* file;
    const char* caption;
    const char* guidance;
    std::int64_t time_ns;
  };
  const std::vector<Plan> plans{
      {"fig5a.png", "(a) Sudden attraction: the tip has jumped to contact and pulls the lever down.",
       "The tip has snapped onto the surface", in->time_ns + kAfterJumpInNs},
      {"fig5b.png", "(b) Pressed: the cantilever bends away from the sample.", "Pressed: the beam bends",
       deepest->time_ns},
      {"fig5c.png", "(c) Sudden adhesion: the last moment before the tip lets go.",
       "Adhesion holds the tip: keep pulling", out->time_ns - kBeforeJumpOffNs},
      {"fig5d.png", "(d) Free: no force after the jump off contact.", "Released: no force any more",
       out->time_ns + kAfterJumpOffNs}};

  // reserved, because the moments point into it
  curves_.reserve(plans.size() + 1);
  for (const Plan& plan : plans) {
    curves_.emplace_back(sessions.size());
    curves_.back()[shown_material] = curve_until(shown, plan.time_ns);
    Moment moment = moment_of(shown, shown_material, plan.time_ns, curves_.back());
    moment.guidance = plan.guidance;
    figures_.push_back({plan.file, plan.caption, moment});
  }

  curves_.emplace_back();
  for (const RecordedSession& session : sessions)
    curves_.back().push_back(curve_until(session, session.samples.back().time_ns));
  Moment finale = moment_of(shown, shown_material, plans.back().time_ns, curves_.back());
  finale.compare_all = true;
  for (const Measurement& m : measurements) {
    finale.felt.push_back({m.title, m.measured.f_attr_n, m.measured.f_ad_n, m.measured.z_jtc_m, m.measured.z_joc_m});
  }
  finale.guidance = "All samples together: the same tip, three materials";
  figures_.push_back({"fig5e.png", "(e) The force-displacement curves of all samples.", finale});
}

core::Result<void> draw_figure(const Figure& figure, const FrameBuilder& frames, render::Renderer& renderer,
                               const std::string& path) {
  renderer.render(frames.build(figure.moment));
  return render::write_png(renderer.read_composed(render::Layout::SideBySide), path);
}

}  // namespace afm::app
