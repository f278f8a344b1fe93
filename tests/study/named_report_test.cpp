// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/written_by.h"
#include "study/study_report.h"
#include "study/study_writer.h"
#include "support/scratch_folder.h"

namespace afm::study {
namespace named_report_test {

TEST(NamedReport, NamesTheProgramInEveryFile) {
  const support::ScratchFolder folder;
  test::StudyWriter writer(folder.path());
  for (unsigned person = 0; person < 2; ++person) writer.add_person(person, test::whole_lesson(person + 1));
  const ReportFiles files = study_report(study_results(read_study(folder.path()).value()));
  EXPECT_GE(files.size(), 6U);
  for (const auto& [name, bytes] : files) {
    if (name == "study.json") {
      EXPECT_EQ(nlohmann::json::parse(bytes)["software_version"], core::kVersion);
    } else {
      EXPECT_THAT(bytes, testing::HasSubstr(core::written_by())) << name;
    }
  }
}

}  // namespace named_report_test
}  // namespace afm::study
