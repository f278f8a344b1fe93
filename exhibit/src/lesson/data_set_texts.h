// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "exhibit/lesson/data_set.h"

namespace afm::exhibit {

// Descriptions of a data set's files, as the Brain Imaging Data Structure requires them.

inline constexpr const char* kMissingValue = "n/a";

// A file in the data set's root, with the names that it may have; the first one is ours.
struct RootFile {
  std::vector<std::string> names;
  std::string text;
};
std::vector<RootFile> root_files();

// Id of a lesson for use in file names: only letters and digits.
std::string task_label(const std::string& lesson);

nlohmann::ordered_json participants_json();

// Replaces in `old` the descriptions of an earlier version, whose levels had no meanings, and the program's name, and
// adds missing ones. Returns whether anything has changed.
bool describe_anew(const nlohmann::ordered_json& now, nlohmann::ordered_json& old);

std::string events_header();
std::string events_json(const Lesson& lesson, const DataSetEntry& entry, std::int64_t day);

}  // namespace afm::exhibit
