// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <iostream>
#include <ostream>
#include <stop_token>
#include <string>
#include <thread>

namespace afm::exhibit {

// Lives while a file is loaded. After a second a separate thread says that loading goes on.
class LoadingNotice {
 public:
  // Waits for the moment to say so; false if the stop comes before it.
  using Wait = std::function<bool(const std::stop_token&)>;
  static bool wait_a_second(const std::stop_token& stop);

  explicit LoadingNotice(const std::string& file, Wait wait = wait_a_second, std::ostream& out = std::cerr);

 private:
  std::jthread thread_;
};

}  // namespace afm::exhibit
