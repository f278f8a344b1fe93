// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.h"

namespace afm::app {

// Options of `touchafm paper`.
struct PaperOptions {
  std::string materials_file;
  std::string summary_file;  // written by a demo; may be empty
  std::string out;
};

// Writes paper.md, paper.json, table1.csv, table2.csv, fig2.svg and fig5e.svg into options.out; writes none of them on
// failure.
core::Result<void> write_paper(const PaperOptions& options);

}  // namespace afm::app
