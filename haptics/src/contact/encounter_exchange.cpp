// SPDX-License-Identifier: Apache-2.0
#include "haptics/encounter_exchange.h"

#include <utility>

namespace afm::haptics {

EncounterExchange::EncounterExchange(std::vector<std::unique_ptr<Encounter>> encounters) : slots_(encounters.size()) {
  for (std::size_t i = 0; i < slots_.size(); ++i) slots_[i].current = std::move(encounters[i]);
}

EncounterExchange::~EncounterExchange() {
  for (Slot& slot : slots_) {
    delete slot.offered.load();
    delete slot.retired.load();
  }
}

bool EncounterExchange::has_offer(std::size_t index) const noexcept {
  const Slot& slot = slots_[index];
  return slot.offered.load(std::memory_order_relaxed) != nullptr &&
         slot.retired.load(std::memory_order_relaxed) == nullptr;
}

void EncounterExchange::take(std::size_t index) noexcept {
  Slot& slot = slots_[index];
  Encounter* before = slot.current.release();
  slot.current.reset(slot.offered.exchange(nullptr, std::memory_order_acquire));
  slot.retired.store(before, std::memory_order_release);
}

void EncounterExchange::offer(std::size_t index, std::unique_ptr<Encounter> encounter) noexcept {
  delete slots_[index].offered.exchange(encounter.release(), std::memory_order_acq_rel);
}

void EncounterExchange::bury() noexcept {
  for (Slot& slot : slots_) delete slot.retired.exchange(nullptr, std::memory_order_acquire);
}

}  // namespace afm::haptics
