// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <hdf5.h>

#include <optional>
#include <string>
#include <vector>

#include "bytes/scaled_unit.h"
#include "hdf5_handles.h"

// Attributes and calibrations of a file of Nanosurf Studio (.nhf), versions 1.1 and 2. Throws CurveError.
namespace afm::curves {

// Text of an attribute; empty if it is missing or of another kind.
std::optional<std::string> text_attribute(hid_t at, const char* name);

// Numbers of an attribute, at most 16; empty if it is missing or of another kind.
std::vector<double> numbers_attribute(hid_t at, const char* name);

// One finite number of an attribute; empty if it is missing or of another kind.
std::optional<double> number_attribute(hid_t at, const char* name);

// Names of the links of a group, the first 1000.
std::vector<std::string> names_in(hid_t group);

// Opens a group or a data set of the file itself; a closed handle for anything else.
Handle group_in(hid_t parent, const std::string& name);
Handle dataset_in(hid_t parent, const std::string& name);

// The file's format: 1 or 2.
double nhf_version(hid_t file);

// Kind of a measurement: "image_line_based", "spectroscopy", or another.
std::string nhf_kind(hid_t group);

// Name of a direction or a part of a curve: "Forward", "Retract 1".
std::string nhf_segment(hid_t segment);

// Name of a channel; empty for a data set without one.
std::string nhf_channel(hid_t channel);

// Points and size of an image, or of a grid of curves; 0: unknown. Version 2 has them as pairs, rows first.
struct NhfGrid {
  double columns = 0, rows = 0, width_m = 0, height_m = 0;
};

// Sets those numbers that the attributes contain.
void read_nhf_grid(hid_t at, NhfGrid& grid);

// Scale of a channel's numbers: the range of their type is that of the values.
struct NhfCalibration {
  double least = 0, most = 1;      // range of the integers
  double lowest = 0, highest = 1;  // range of the values
  ScaledUnit unit;

  double value(double number) const {
    return unit.factor * (lowest + (highest - lowest) / (most - least) * (number - least));
  }
};

// `has_fill_value`: from version 2 on, one value of the type means that nothing was measured.
NhfCalibration nhf_calibration(hid_t channel, bool has_fill_value);

}  // namespace afm::curves
