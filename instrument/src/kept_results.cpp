// SPDX-License-Identifier: Apache-2.0
#include "kept_results.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

#include "core/new_file.h"
#include "curves/curve_output.h"
#include "curves/curve_series.h"
#include "curves/image_output.h"
#include "curves/recorded_curve.h"
#include "refused_request.h"

namespace afm::instrument {
namespace {

bool is_plain(const std::string& name) {
  return !name.empty() && name.front() != '.' && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-' ||
           c == '_';
  });
}

// Curve as a microscope would save it: with the forces that its detector shows, without numbers that it cannot know.
// Used only for saving.
curves::RecordedCurve recorded(const curves::CurveRun& run, const std::vector<double>& shown_n) {
  curves::RecordedCurve kept = curves::recorded_curve(run);
  kept.metadata.parameters.clear();
  for (std::size_t i = 0; i < kept.points.size(); ++i) kept.points[i].force = physics::Force(shown_n.at(i));
  return kept;
}

}  // namespace

void KeptResults::forget() {
  curve_.reset();
  image_.reset();
}

void KeptResults::save(const std::string& name) const {
  if (!is_plain(name)) throw RefusedRequest("\"file\": give a name of letters, digits, \"-\", \"_\" and \".\"");
  if (folder_.empty()) throw RefusedRequest("no folder was given; start touchafm serve with --out DIR");
  const std::string path = (std::filesystem::path(folder_) / name).string();
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored)) throw RefusedRequest("there is already a file " + name);
  if (const auto format = curves::image_format(name)) {
    if (!image_) throw RefusedRequest("there is no image yet; \"scan\" first");
    value_of(core::write_new_file(
        path, *format == curves::ImageFormat::Gsf ? curves::gsf_bytes(*image_, 0) : curves::gwy_bytes(*image_)));
  } else if (const auto curve_format = curves::writable_format_of(name)) {
    if (!curve_) throw RefusedRequest("there is no curve yet; \"curve\" first");
    value_of(core::write_new_file(
        path,
        value_of(curves::series_bytes(curve_format->format, std::array{recorded(curve_->first, curve_->second)}))));
  } else {
    throw RefusedRequest("\"file\": name it .gwy or .gsf for the newest image, .h5, .tab or .csv for the newest curve");
  }
}

}  // namespace afm::instrument
