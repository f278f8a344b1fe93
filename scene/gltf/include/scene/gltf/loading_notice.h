// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <iostream>
#include <ostream>
#include <stop_token>
#include <string>
#include <thread>

namespace afm::scene {

// Exists while a file is loaded. After a second, a separate thread reports that loading continues.
class LoadingNotice {
 public:
  // Waits until the report is due; returns false if stopped before.
  using Wait = std::function<bool(const std::stop_token&)>;
  static bool wait_a_second(const std::stop_token& stop);

  explicit LoadingNotice(const std::string& file, Wait wait = wait_a_second, std::ostream& out = std::cerr);

 private:
  std::jthread thread_;
};

}  // namespace afm::scene
