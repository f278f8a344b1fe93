// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/analyse/analyse_command.h"
#include "core/result.h"

namespace afm::app {

// Fits every curve of each file and writes FOLDER/fits.tsv, one row per curve in the given order, as soon as it and all
// before it are known: an interruption leaves the rows so far. An unreadable or unfitted curve is a row with the
// reason. Writes the maps of each file whose curves have pixels, and the histograms of all moduli. The bytes do not
// depend on `threads`. `options` has a prepared fit; its `out` is the folder, which is created if it does not
// exist. Prints how many were trusted, and the figures of the trusted and the doubtful. WrongUsage if the table exists
// already; BadInputFile if no file has a curve that can be fitted.
core::Result<void> fit_files(const std::vector<std::string>& files, const AnalyseOptions& options, unsigned threads);

}  // namespace afm::app
