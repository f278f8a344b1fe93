// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thread>

namespace afm::haptics {

class EditBuilder;

// Thread that builds during its lifetime. It inherits the scheduling of its creator, so create it before that thread
// becomes real-time.
class EditThread {
 public:
  explicit EditThread(EditBuilder& builder);

 private:
  std::jthread thread_;
};

}  // namespace afm::haptics
