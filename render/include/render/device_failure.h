// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace afm::render {

// The graphics device or the display is lost, or no memory is left: what Renderer, Presenter and Window throw where
// their comments name no other way. One line for people. Nothing more can be drawn with that renderer; it can be
// destroyed.
class DeviceFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace afm::render
