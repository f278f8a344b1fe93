// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/file_descriptor.h"
#include "core/result.h"
#include "exhibit/lesson/lesson.h"
#include "exhibit/lesson/lesson_run.h"
#include "exhibit/lesson/trial_row.h"

namespace afm::exhibit {

// Destination of a lesson's results, and details for its JSON.
struct DataSetEntry {
  std::string folder;  // path of the study's folder
  std::string code;    // participant's code, six capital letters
  std::string device, wall;
  std::uint64_t seed = 0;
  std::string age_band{};              // word of kAgeBands; empty: not given
  std::string observer{};              // JSON object describing a simulated participant; empty for a person
  std::string samples{};               // text of samples_json(); empty: not given
  std::optional<std::size_t> order{};  // row of the Williams design used for the lesson; empty: the next free one
  std::optional<std::int64_t>
      day{};  // date of a person's lesson, in days since 1970; stored only as the distance to the study's first day
};

// Returns whether the text is six capital letters.
bool is_participant_code(std::string_view code);

// Row of the Williams design for a code: its stored row, or the next one of the folder.
core::Result<std::size_t> order_of(const std::string& folder, const std::string& code);

// WrongUsage if this participant has already done the lesson.
core::Result<void> check_not_done(const Lesson& lesson, const std::string& folder, const std::string& code);

// Files of one participant's lesson in a study's folder, as the Brain Imaging Data Structure 1.8.0 requires (columns:
// docs/manual/teach.md): dataset_description.json, README, participants.tsv and .json, and for each participant
// sub-CODE/beh/sub-CODE_task-NAME_events.tsv and .json, where NAME is the lesson's id without dashes. Whole files are
// replaced in one step, and a line of events.tsv is written when its trial ends, so a killed program loses at most the
// running trial. Never overwrites a participant's finished lesson. Several programs may write into one folder. One
// thread.
class DataSet {
 public:
  // Creates the files. WrongUsage if this participant has already done the lesson.
  static core::Result<DataSet> create(const Lesson& lesson, const DataSetEntry& entry);

  core::Result<void> add(const TrialRow& row);

  // Records in the events' JSON that the sound failed this long after the lesson's start.
  core::Result<void> note_sound_lost(double onset_s);

  // Records the lesson's end in participants.tsv.
  core::Result<void> finish(LessonEnd end);

  std::size_t order() const { return order_; }  // row of the Williams design, as in participants.tsv

  // Name of the participant's folder: sub-CODE.
  const std::string& participant_folder() const { return participant_folder_; }

 private:
  DataSet() = default;

  std::string folder_, code_, participant_folder_, events_path_, description_path_;
  std::size_t order_ = 0;
  core::FileDescriptor events_;
};

// A line of events.tsv, including the line end.
std::string line_of(const TrialRow& row);

// Deletes the participant's folder and row. WrongUsage if neither exists.
core::Result<void> withdraw(const std::string& folder, const std::string& code);

}  // namespace afm::exhibit
