// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "app/view/pointed.h"
#include "input/wand.h"

namespace afm::app {

// Guides a person through the window and takes the person's answers first.
class ViewGuide {
 public:
  virtual ~ViewGuide() = default;

  // Handles a key from 1 to 9, as a number from 0. Returns false if the key chooses a sample as usual.
  virtual bool number(std::size_t number) = 0;

  // Handles the keys + (1) and - (-1).
  virtual void step(int steps) = 0;

  // Handles Enter, which also removes the force unless the guide only waits for it.
  virtual void enter() = 0;

  // Handles a press of a pointing device.
  virtual void press(const Pointed& pointed, const input::Ray& ray) = 0;

  // Speech for this line of guidance.
  virtual std::string spoken(const std::string& line) = 0;
};

}  // namespace afm::app
