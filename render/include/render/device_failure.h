// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace afm::render {

// The graphics device or the display was lost, or memory ran out. Renderer, Presenter and Window throw it unless their
// comments say otherwise. what() is one line for users. That renderer cannot draw any more; it can only be destroyed.
class DeviceFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace afm::render
