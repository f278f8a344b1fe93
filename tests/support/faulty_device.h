// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdlib.h>

#include <string>
#include <vector>

#include "support/places.h"

namespace afm::test {

// Command line that runs a program whose graphics device fails in this way, or has fewer abilities.
inline std::vector<std::string> on_faulty_device(const std::string& fault, const std::vector<std::string>& program) {
  std::vector<std::string> command{"/usr/bin/env", "VK_ADD_LAYER_PATH=" + support::fault_layer_folder(),
                                   "VK_INSTANCE_LAYERS=VK_LAYER_AFM_fault", "AFM_TEST_FAULT=" + fault};
  command.insert(command.end(), program.begin(), program.end());
  return command;
}

// While it exists, a layer between new Vulkan instances and the driver makes the device fail as described in
// tests/support/fault_layer. One at a time.
class FaultyDevice {
 public:
  explicit FaultyDevice(const std::string& fault) {
    setenv("VK_ADD_LAYER_PATH", support::fault_layer_folder().c_str(), 1);
    setenv("VK_INSTANCE_LAYERS", "VK_LAYER_AFM_fault", 1);
    setenv("AFM_TEST_FAULT", fault.c_str(), 1);
  }
  FaultyDevice(const FaultyDevice&) = delete;
  FaultyDevice& operator=(const FaultyDevice&) = delete;
  ~FaultyDevice() {
    unsetenv("VK_ADD_LAYER_PATH");
    unsetenv("VK_INSTANCE_LAYERS");
    unsetenv("AFM_TEST_FAULT");
  }
};

}  // namespace afm::test
