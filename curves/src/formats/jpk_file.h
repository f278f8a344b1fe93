// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "bytes/zip_archive.h"
#include "curves/curve_file.h"
#include "curves/recorded_curve.h"
#include "formats/jpk_properties.h"

namespace afm::curves {

// JPK's .jpk-force, and its maps: .jpk-force-map, .jpk-qi-data. A zip archive with a folder for each segment of the
// curve, or of the numbered curves in the folder "index". Leaves out pauses and oscillations, with a remark. Throws
// CurveError.
class JpkArchive {
 public:
  // The bytes must outlive the object.
  explicit JpkArchive(std::string_view bytes);
  JpkArchive(const JpkArchive&) = delete;
  JpkArchive& operator=(const JpkArchive&) = delete;

  // Number of curves.
  std::size_t size() const { return folders_.size(); }

  // Curve of an index below size().
  RecordedCurve curve(std::size_t index, const CurveReading& reading) const;

 private:
  std::vector<std::size_t> folders_;  // numbers of the curves in the folder "index", rising; only 0 without that folder
  ZipArchive archive_;                // archive, whose listing fills folders_
  bool is_map_;
  JpkProperties general_, shared_;
};

}  // namespace afm::curves
