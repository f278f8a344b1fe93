// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

#include "haptics/contact_model.h"

namespace afm::haptics {

// Contact models of all materials, each replaceable while the servo runs. Used by two threads: the servo's, which
// neither waits nor frees, and the builder's, which creates and frees contact models.
//
//   builder --offer()--> offered --adopt()--> current --adopt()--> retired --reclaim()--> freed by the builder
class ModelSwap {
 public:
  explicit ModelSwap(std::vector<std::unique_ptr<ContactModel>> models);
  ModelSwap(const ModelSwap&) = delete;
  ModelSwap& operator=(const ModelSwap&) = delete;
  ~ModelSwap();

  std::size_t size() const noexcept { return slots_.size(); }

  // ---- servo's thread; index < size() ----

  ContactModel& current(std::size_t index) noexcept { return *slots_[index].current; }

  // True if a new contact model is ready and the previously retired one has been reclaimed, which leaves a free slot.
  bool has_offer(std::size_t index) const noexcept;

  // Replaces the current model with the offer; the old one must not be used any more. Call only after has_offer().
  void adopt(std::size_t index) noexcept;

  // ---- builder's thread ----

  // Replaces an offer that has not been adopted yet.
  void offer(std::size_t index, std::unique_ptr<ContactModel> model) noexcept;
  void reclaim() noexcept;

 private:
  // A contact model belongs to the thread that exchanged its pointer out.
  struct Slot {
    std::unique_ptr<ContactModel> current;
    std::atomic<ContactModel*> offered{nullptr};
    std::atomic<ContactModel*> retired{nullptr};
  };

  std::vector<Slot> slots_;  // never resized
};

}  // namespace afm::haptics
