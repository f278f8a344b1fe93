// SPDX-License-Identifier: Apache-2.0
#include "haptics/edit_builder.h"

#include <fmt/core.h>

#include <chrono>
#include <cstddef>
#include <span>

#include "core/log.h"
#include "haptics/edit_thread.h"
#include "haptics/felt_particles.h"

namespace afm::haptics {

namespace {
// Interval of checks for edits, short enough for a hand that turns a knob; a check costs less than a microsecond.
constexpr auto kLookEvery = std::chrono::milliseconds(5);
}  // namespace

core::Result<std::unique_ptr<ContactModel>> EditBuilder::model_of(const scene::MaterialEdit& edit) const {
  const bool has_curve = edit.curve.approach_count > 0;
  if (has_curve && !scene::is_valid(edit.curve)) {
    return core::failure(core::ErrorCategory::Failed, "its measured curve is not in order of increasing Z");
  }
  scene::SharedContact material = edit.material;
  if (has_curve) material.measured_curve = 0;
  std::span<const scene::SharedMeasuredCurve> curves = curves_;
  if (has_curve) curves = std::span(&edit.curve, 1);
  auto tables = build_tables(material, curves);
  if (!tables) return tl::unexpected(tables.error());
  return ContactModel::create(material, edit.revision, std::move(*tables),
                              scene::surface_of(material, surfaces_, topography_), common_, device_, period_ns_,
                              law_map_.get());
}

void EditBuilder::build() {
  exchange_.reclaim();
  if (const auto selection = edits_.new_selection()) settings_ = selection->settings;
  particles_.build(settings_);
  for (std::size_t i = 0; i < exchange_.size(); ++i) {
    const auto edit = edits_.new_edit(static_cast<std::uint32_t>(i));
    if (!edit) continue;
    auto model = model_of(*edit);
    if (model) {
      exchange_.offer(i, std::move(*model));
    } else {
      core::log_line(fmt::format("the material is unchanged: {}", model.error().message));
      refused_.store(edit->revision, std::memory_order_relaxed);
    }
  }
}

EditThread::EditThread(EditBuilder& builder)
    : thread_([&builder](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
          builder.build();
          std::this_thread::sleep_for(kLookEvery);
        }
      }) {}

}  // namespace afm::haptics
