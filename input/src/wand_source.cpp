// SPDX-License-Identifier: Apache-2.0
#include "input/wand_source.h"

#include <utility>

namespace afm::input {

WandThread::WandThread(std::unique_ptr<WandSource> source) : source_(std::move(source)), thread_([this] { run(); }) {}

WandThread::~WandThread() {
  ending_ = true;
  thread_.join();
}

void WandThread::run() {
  while (!ending_) newest_.store(source_->poll());
}

}  // namespace afm::input
