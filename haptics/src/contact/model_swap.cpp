// SPDX-License-Identifier: Apache-2.0
#include "haptics/model_swap.h"

#include <utility>

namespace afm::haptics {

ModelSwap::ModelSwap(std::vector<std::unique_ptr<ContactModel>> models) : slots_(models.size()) {
  for (std::size_t i = 0; i < slots_.size(); ++i) slots_[i].current = std::move(models[i]);
}

ModelSwap::~ModelSwap() {
  for (Slot& slot : slots_) {
    delete slot.offered.load();
    delete slot.retired.load();
  }
}

bool ModelSwap::has_offer(std::size_t index) const noexcept {
  const Slot& slot = slots_[index];
  return slot.offered.load(std::memory_order_relaxed) != nullptr &&
         slot.retired.load(std::memory_order_relaxed) == nullptr;
}

void ModelSwap::adopt(std::size_t index) noexcept {
  Slot& slot = slots_[index];
  ContactModel* before = slot.current.release();
  slot.current.reset(slot.offered.exchange(nullptr, std::memory_order_acquire));
  slot.retired.store(before, std::memory_order_release);
}

void ModelSwap::offer(std::size_t index, std::unique_ptr<ContactModel> model) noexcept {
  delete slots_[index].offered.exchange(model.release(), std::memory_order_acq_rel);
}

void ModelSwap::reclaim() noexcept {
  for (Slot& slot : slots_) delete slot.retired.exchange(nullptr, std::memory_order_acquire);
}

}  // namespace afm::haptics
