// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "haptics/device.h"
#include "haptics/model_swap.h"
#include "scene/shared/shared_segment.h"

namespace afm::haptics {

// Makes contact models of the edits that arrive while the servo runs, and offers them to it. One thread, which is not
// the servo's: building allocates and takes milliseconds.
class EditBuilder {
 public:
  // Curves, surfaces and the topography as those of the segment; `common` as for the contact models that are there;
  // `exchange` must outlive it.
  EditBuilder(scene::EditSide edits, std::vector<scene::SharedMeasuredCurve> curves,
              std::vector<scene::SharedHeightField> surfaces, scene::Topography topography, const CommonScale& common,
              const DeviceSpec& device, std::int64_t period_ns, ModelSwap& exchange)
      : edits_(edits),
        curves_(std::move(curves)),
        surfaces_(std::move(surfaces)),
        topography_(std::move(topography)),
        common_(common),
        device_(device),
        period_ns_(period_ns),
        exchange_(exchange) {}

  // Builds what is new and frees what the servo has put aside. An edit that cannot be felt is logged and refused.
  void build();

  // Revision of the newest edit that cannot be felt, 0 for none. Any thread, wait-free.
  std::uint32_t refused() const noexcept { return refused_.load(std::memory_order_relaxed); }

 private:
  core::Result<std::unique_ptr<ContactModel>> model_of(const scene::MaterialEdit& edit) const;

  scene::EditSide edits_;
  std::vector<scene::SharedMeasuredCurve> curves_;
  std::vector<scene::SharedHeightField> surfaces_;
  scene::Topography topography_;
  CommonScale common_;
  DeviceSpec device_;
  std::int64_t period_ns_;
  ModelSwap& exchange_;
  std::atomic<std::uint32_t> refused_{0};
};

// A thread that builds as long as this lives. It has the scheduling of the thread that makes it: make it before that
// one becomes real-time.
class EditThread {
 public:
  explicit EditThread(EditBuilder& builder);

 private:
  std::jthread thread_;
};

}  // namespace afm::haptics
