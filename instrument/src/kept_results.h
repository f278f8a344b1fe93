// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "curves/curve_run.h"
#include "physics/imaging/scan_image.h"

namespace afm::instrument {

// The newest curve and image of an instrument, which a client may save.
class KeptResults {
 public:
  // `folder` is the folder into which save() writes; empty: none.
  explicit KeptResults(std::string folder) : folder_(std::move(folder)) {}

  // `shown_n`: force of each sample as the detector shows it.
  void keep(curves::CurveRun run, std::vector<double> shown_n) { curve_ = {std::move(run), std::move(shown_n)}; }
  void keep(physics::ScanImage image) { image_ = std::move(image); }
  void forget();

  // Writes a new file, in the format of its name. RefusedRequest if the name is none of a plain file within the folder,
  // if there is such a file, or nothing that this format can contain.
  void save(const std::string& name) const;

 private:
  std::string folder_;
  std::optional<std::pair<curves::CurveRun, std::vector<double>>> curve_;
  std::optional<physics::ScanImage> image_;
};

}  // namespace afm::instrument
