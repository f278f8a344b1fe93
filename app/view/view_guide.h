// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "app/view/pointed.h"
#include "input/wand.h"

namespace afm::app {

// Somebody who guides a person through the window and takes their answers first.
class ViewGuide {
 public:
  virtual ~ViewGuide() = default;

  // A key from 1 to 9, as a number from 0. False: it chooses a sample as usual.
  virtual bool number(std::size_t number) = 0;

  // The keys + and -.
  virtual void step(int steps) = 0;

  // Enter, which also takes the force away unless the guide only waits for it.
  virtual void enter() = 0;

  // A press of a pointing device.
  virtual void press(const Pointed& pointed, const input::Ray& ray) = 0;

  // What is spoken while `line` is the line of guidance.
  virtual std::string spoken(const std::string& line) = 0;
};

}  // namespace afm::app
