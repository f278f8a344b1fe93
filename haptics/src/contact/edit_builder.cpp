// SPDX-License-Identifier: Apache-2.0
#include "haptics/edit_builder.h"

#include <fmt/core.h>

#include <chrono>
#include <cstddef>

#include "core/log.h"
#include "haptics/edit_thread.h"

namespace afm::haptics {

namespace {
// Short enough for a hand that turns a knob; a check costs less than a microsecond.
constexpr auto kLookEvery = std::chrono::milliseconds(5);
}  // namespace

core::Result<std::unique_ptr<ContactModel>> EditBuilder::model_of(const scene::MaterialEdit& edit) const {
  auto tables = build_tables(edit.material, curves_);
  if (!tables) return tl::unexpected(tables.error());
  return ContactModel::create(edit.material, edit.revision, std::move(*tables),
                              scene::surface_of(edit.material, surfaces_, topography_), common_, device_, period_ns_);
}

void EditBuilder::build() {
  exchange_.reclaim();
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
