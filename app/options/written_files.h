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
  bool reads = false;   // true: a value is a file to read, alone or after a word and a colon
  bool writes = false;  // true: the last value is a file to write
  bool draws = false;   // true: the written file is a picture, not data
};

// WrongUsage if a file to be written is one that another option reads, or a measurement, which would be lost.
core::Result<void> check_written_files(std::span<const GivenOption> given);

}  // namespace afm::app
