// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "haptics/device.h"
#include "haptics/model_swap.h"
#include "scene/shared/shared_segment.h"

namespace afm::haptics {

class ParticleSwap;

// Builds contact models for the edits that arrive while the servo runs, and particles with the settings of a selection,
// and offers them to it. One thread, but not the servo's: building allocates and takes milliseconds.
class EditBuilder {
 public:
  // Curves, surfaces, topography and map are those of the segment, the map null if there is none; `common` is that of
  // the existing contact models; `exchange` and `particles` must outlive this object.
  EditBuilder(scene::EditSide edits, std::vector<scene::SharedMeasuredCurve> curves,
              std::vector<scene::SharedHeightField> surfaces, scene::Topography topography,
              std::unique_ptr<const scene::SharedLawMap> law_map, const CommonScale& common, const DeviceSpec& device,
              std::int64_t period_ns, ModelSwap& exchange, ParticleSwap& particles)
      : edits_(edits),
        curves_(std::move(curves)),
        surfaces_(std::move(surfaces)),
        topography_(std::move(topography)),
        law_map_(std::move(law_map)),
        common_(common),
        device_(device),
        period_ns_(period_ns),
        exchange_(exchange),
        particles_(particles) {}

  // Builds new models and particles, and frees those that the servo has retired. Edits that cannot be felt are logged
  // and refused.
  void build();

  // Revision of the newest edit that cannot be felt, 0 for none. Any thread, wait-free.
  std::uint32_t refused() const noexcept { return refused_.load(std::memory_order_relaxed); }

 private:
  core::Result<std::unique_ptr<ContactModel>> model_of(const scene::MaterialEdit& edit) const;

  scene::EditSide edits_;
  std::vector<scene::SharedMeasuredCurve> curves_;
  std::vector<scene::SharedHeightField> surfaces_;
  scene::Topography topography_;
  std::unique_ptr<const scene::SharedLawMap> law_map_;
  CommonScale common_;
  DeviceSpec device_;
  std::int64_t period_ns_;
  ModelSwap& exchange_;
  ParticleSwap& particles_;
  scene::PushSettings settings_{};  // settings of the newest selection
  std::atomic<std::uint32_t> refused_{0};
};

}  // namespace afm::haptics
