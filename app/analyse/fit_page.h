// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "curves/fitting/fitted_curve.h"
#include "fits/elastic_fit.h"

namespace afm::app {

// The page of a batch of fits, one self-contained HTML file: results and histograms, settings, the modulus of each map,
// files, doubts, and curves without a fit. Lists end at kMostRows, and say so; the table of the batch has all curves.
class FitPage {
 public:
  static constexpr std::size_t kMostRows = 200, kMostMaps = 12;

  using Texts = std::vector<std::pair<std::string, std::string>>;

  // Begins a file; the following curves are its curves, in order.
  void begin(const std::string& file);
  void add(const curves::FittedCurve& fitted);
  void add_map(std::string png);  // PNG bytes for the current file

  // `results` has one line per entry; `settings` are those of the fit by column; `histograms` is SVG, or empty.
  std::string html(const std::vector<std::string>& results, const Texts& settings, const std::string& histograms) const;

 private:
  struct FileRow {
    std::string name;
    std::size_t curves = 0, unread = 0;
    std::array<std::size_t, 3> trusts{};  // counts in the order of Trust
    double median_pa = 0;                 // median of trusted and doubtful fits; 0: none
  };
  struct Unfitted {
    std::string file;
    std::size_t index;  // number of the curve in the file
    std::string why;
  };
  struct Picture {
    std::string file, png;
  };

  FileRow with_median() const;  // row of the current file
  std::string files_html() const;
  std::string doubts_html() const;
  std::string unfitted_html() const;

  std::vector<FileRow> files_;  // finished files, without the current one
  FileRow current_;
  std::vector<double> moduli_pa_;  // moduli of the current file
  std::map<fits::Doubt, std::size_t> doubts_;
  std::vector<Unfitted> unfitted_;
  std::size_t files_begun_ = 0, curves_ = 0, unread_ = 0;
  std::vector<Picture> maps_;
};

}  // namespace afm::app
