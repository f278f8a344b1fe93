// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "app/options/command.h"
#include "core/log.h"
#include "core/output_folder.h"
#include "study/study_data.h"
#include "study/study_report.h"

namespace afm::app {

namespace {

struct StudyOptions {
  std::string folder;
  std::string out;
};

core::Result<void> write_study(const StudyOptions& options) {
  const auto data = study::read_study(options.folder);
  if (!data) return tl::unexpected(data.error());
  const study::ReportFiles files = study::study_report(study::study_results(*data));
  auto folder = core::OutputFolder::open(options.out);
  if (!folder) return tl::unexpected(folder.error());
  for (const auto& [name, bytes] : files) {
    if (const auto written = folder->write(name, bytes); !written) return written;
  }
  return folder->commit();
}

}  // namespace

void add_study_command(OptionList& program, const CommandContext&) {
  OptionList command = program.add_command(
      "study", "pool the results of a study's participants into one report, beside the paper's Table 3");
  // shared: the parser writes into it while it lives, the chosen command reads it afterwards
  const auto options = std::make_shared<StudyOptions>();
  command
      .add_option("folder", options->folder, "folder of the study: participants.tsv and a folder for each participant")
      .required()
      .type_name("DIR");
  command
      .add_option("--out", options->out,
                  "folder for study.md, study.html, study.json and the figures; created if it does not exist")
      .required()
      .type_name("DIR");
  command.footer("example: touchafm study class --out report");
  command.when_chosen([options] {
    auto done = write_study(*options);
    if (done) core::log_line(fmt::format("open {}/study.html", options->out));
    return done;
  });
}

}  // namespace afm::app
