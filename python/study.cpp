// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/errors.h"
#include "python/json.h"
#include "python/long_work.h"
#include "python/result_type.h"
#include "study/study_data.h"
#include "study/study_report.h"

namespace afm::python {

namespace {

namespace py = pybind11;
using study::StudyTrial;

// touchafm.Study.
struct Study {
  study::StudyData data;
  study::StudyResults results;
};

std::shared_ptr<Study> read(const std::filesystem::path& folder) {
  return value_of(long_work([folder = folder.string()](const std::stop_token&) -> core::Result<std::shared_ptr<Study>> {
    auto data = study::read_study(folder);
    if (!data) return tl::unexpected(data.error());
    auto read = std::make_shared<Study>();
    read->results = study::study_results(*data);
    read->data = std::move(*data);
    return read;
  }));
}

double or_nan(const std::optional<double>& value) { return value.value_or(std::numeric_limits<double>::quiet_NaN()); }
double truth_or_nan(const std::optional<bool>& value) {
  return or_nan(value ? std::optional(*value ? 1.0 : 0.0) : std::nullopt);
}

py::dict trials_of(const Study& self) {
  std::vector<std::string> participants, lessons;
  std::vector<const StudyTrial*> trials;
  for (const study::StudyData::Member& member : self.data.members) {
    for (const study::LessonVisit& visit : member.visits) {
      for (const StudyTrial& trial : visit.trials) {
        participants.push_back(member.person.id);
        lessons.push_back(visit.task);
        trials.push_back(&trial);
      }
    }
  }
  py::dict columns;
  columns["participant"] = participants;
  columns["lesson"] = lessons;
  const auto add = [&](const char* name, auto value) { columns[name] = computed(trials, value); };
  const auto add_text = [&](const char* name, auto value) {
    py::list texts;
    for (const StudyTrial* trial : trials) texts.append(value(*trial));
    columns[name] = texts;
  };
  add_text("step", [](const StudyTrial& trial) { return trial.step; });
  add_text("kind", [](const StudyTrial& trial) { return study::word_of(trial.kind); });
  add_text("condition", [](const StudyTrial& trial) { return trial.condition; });
  add_text("stimulus", [](const StudyTrial& trial) { return trial.stimulus; });
  add_text("response", [](const StudyTrial& trial) { return trial.response; });
  add("trial", [](const StudyTrial* trial) { return trial->trial; });
  add("practice", [](const StudyTrial* trial) { return trial->practice; });
  add("onset", [](const StudyTrial* trial) { return trial->onset_s; });
  add("duration", [](const StudyTrial* trial) { return trial->duration_s; });
  add("level", [](const StudyTrial* trial) { return or_nan(trial->level); });
  add("value", [](const StudyTrial* trial) { return or_nan(trial->value); });
  add("right", [](const StudyTrial* trial) { return truth_or_nan(trial->right); });
  add("reaction_time", [](const StudyTrial* trial) { return or_nan(trial->rt_s); });
  add("force", [](const StudyTrial* trial) { return truth_or_nan(trial->force); });
  return columns;
}

}  // namespace

void add_studies(py::module_& module) {
  py::class_<Study, std::shared_ptr<Study>>(module, "Study", plain_type(), py::is_final(),
                                            "A study's data set and what it shows (docs/teaching.md). Immutable.")
      .def_property_readonly(
          "participants",
          [](const Study& self) {
            std::vector<std::string> ids;
            ids.reserve(self.data.members.size());
            for (const study::StudyData::Member& member : self.data.members) ids.push_back(member.person.id);
            return ids;
          },
          "People whose trials count, by their ids.")
      .def_property_readonly(
          "left_out", [](const Study& self) { return self.data.left_out; },
          "People who were left out, with the reasons.")
      .def_property_readonly("trials", &trials_of,
                             "Every trial, practice included, as columns of equal length by name, for a data frame: "
                             "texts as lists, empty for n/a; numbers as arrays, NaN for n/a. onset, duration and "
                             "reaction_time are in s, right and force are 1 or 0, value is in N for cycles.")
      .def(
          "as_dict", [](const Study& self) { return dict_of_text(study::study_json(self.results)); },
          "study.json of touchafm study: every figure with its interval.")
      .def("__repr__",
           [](const Study& self) { return fmt::format("<touchafm.Study of {} people>", self.data.members.size()); });
  module.def("study", &read, py::arg("folder"),
             "The study in a folder of touchafm lesson: participants.tsv and a folder for each participant.\n"
             "FileError if it is none, or a file of it is not valid.");
}

}  // namespace afm::python
