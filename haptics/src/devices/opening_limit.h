// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace afm::haptics {

// Ends the process if a driver does not return from a call that opens or probes a device: a thread stuck in a vendor's
// library can be neither interrupted nor left behind. No force is possible at that point. Create one around the call;
// the process ends with DeviceMissing and one line that names `subject`.
class OpeningLimit {
 public:
  // Throws std::system_error if no thread can be created.
  OpeningLimit(std::string subject, std::chrono::milliseconds limit);
  OpeningLimit(const OpeningLimit&) = delete;
  OpeningLimit& operator=(const OpeningLimit&) = delete;
  ~OpeningLimit();

 private:
  void wait(const std::string& subject, std::chrono::milliseconds limit);

  std::mutex mutex_;
  std::condition_variable over_;
  bool done_ = false;
  std::thread thread_;
};

}  // namespace afm::haptics
