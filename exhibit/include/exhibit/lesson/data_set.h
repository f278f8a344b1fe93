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

// Where a lesson's results go, and what is said of them in task-NAME_events.json.
struct DataSetEntry {
  std::string folder;  // DIR
  std::string code;    // six capital letters
  std::string device, wall;
  std::uint64_t seed = 0;
  std::string age_band{};              // a word of kAgeBands; empty: not given
  std::string observer{};              // JSON object of a simulated participant; empty for a person
  std::optional<std::size_t> order{};  // by which the lesson was planned; none: the next one that is free
  std::optional<std::int64_t>
      day{};  // days since 1970 of a person's lesson, kept only as a distance to the first one's
};

// True for six capital letters.
bool is_participant_code(std::string_view code);

// The row of the Williams design that a code has or would be given: the next one in the folder.
core::Result<std::size_t> order_of(const std::string& folder, const std::string& code);

// WrongUsage where this participant has done the lesson already.
core::Result<void> check_not_done(const Lesson& lesson, const std::string& folder, const std::string& code);

// Files of one participant's lesson in a study's folder, as BIDS lays them out (docs/manual.md has their columns):
// participants.tsv and .json, sub-CODE/task-NAME_events.tsv and .json. Whole files are replaced in one step, and a line
// of events.tsv is written as its trial ends, so that a killed program loses at most the running trial. Never
// overwrites a lesson that this participant has done. Several programs may write into one folder. One thread.
class DataSet {
 public:
  // Makes the files. WrongUsage where this participant has done the lesson already.
  static core::Result<DataSet> create(const Lesson& lesson, const DataSetEntry& entry);

  core::Result<void> add(const TrialRow& row);

  // Says in the events' JSON that the sound ended so late in the lesson.
  core::Result<void> note_sound_lost(double onset_s);

  // Says in participants.tsv how it ended.
  core::Result<void> finish(LessonEnd end);

  std::size_t order() const { return order_; }  // as participants.tsv has it

  // sub-CODE
  const std::string& participant_folder() const { return participant_folder_; }

 private:
  DataSet() = default;

  std::string folder_, code_, participant_folder_, events_path_, description_path_;
  std::size_t order_ = 0;
  core::FileDescriptor events_;
};

// A line of events.tsv, with its end.
std::string line_of(const TrialRow& row);

// Deletes the participant's folder and row. WrongUsage where there is neither.
core::Result<void> withdraw(const std::string& folder, const std::string& code);

}  // namespace afm::exhibit
