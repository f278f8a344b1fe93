// SPDX-License-Identifier: Apache-2.0
#include "servo/tip_listener.h"

#include <chrono>

namespace afm::servo {

namespace {

constexpr std::chrono::milliseconds kPause(2);

}  // namespace

TipListener::TipListener(scene::RendererSide side, TipAudience& audience)
    : side_(side), audience_(audience), thread_([this] { listen(); }) {}

TipListener::~TipListener() {
  ending_ = true;
  thread_.join();
}

void TipListener::take_events() noexcept {
  while (const auto event = side_.pop_event()) {
    audience_.heard(*event);
    handed_on_->events.push(*event);
  }
}

// Passes on an event before the sample of its tick, as it was stored.
void TipListener::take_all() noexcept {
  while (const auto sample = side_.pop_sample()) {
    take_events();
    audience_.heard(*sample);
    handed_on_->samples.push(*sample);
  }
}

void TipListener::listen() noexcept {
  while (!ending_) {
    take_all();
    std::this_thread::sleep_for(kPause);
  }
}

}  // namespace afm::servo
