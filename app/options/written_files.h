// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/result.h"

namespace afm::app {

// Option that was given on the command line.
struct GivenOption {
  std::string name;
  std::vector<std::string> values;
  bool reads = false;   // a value is a file that is read, alone or behind a word and a colon
  bool writes = false;  // the last value is a file that is written
  bool draws = false;   // picture in that file, not data
};

// WrongUsage if a file would be written that another option reads, or that is a measurement, which would be lost.
core::Result<void> check_written_files(std::span<const GivenOption> given);

}  // namespace afm::app
