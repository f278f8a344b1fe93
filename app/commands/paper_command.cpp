// SPDX-License-Identifier: Apache-2.0
#include "app/commands/paper_command.h"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/options/command.h"
#include "core/log.h"
#include "core/output_folder.h"
#include "curves/paper_report.h"
#include "curves/paper_tables.h"
#include "study/survey_report.h"

namespace afm::app {

core::Result<void> write_paper(const PaperOptions& options) {
  const auto library = scene::load_materials(options.materials_file);
  if (!library) return tl::unexpected(library.error());
  const auto samples = library->only(scene::kPaperMaterials);
  if (!samples) {
    return core::failure(core::ErrorCategory::BadInputFile,
                         fmt::format("material file {} lacks a sample of the paper: {}", options.materials_file,
                                     samples.error().message));
  }
  const bool of_a_demo = !options.summary_file.empty();
  const core::Result<curves::MeasuredEvents> measured =
      of_a_demo ? curves::load_measured_events(options.summary_file)
                : core::Result<curves::MeasuredEvents>(curves::measured_events(*samples));
  if (!measured) return tl::unexpected(measured.error());
  const auto tables = curves::paper_tables(*samples, *measured);
  if (!tables) return tl::unexpected(tables.error());
  const char* run = of_a_demo ? "of the demo" : "of the model, which looks every 0.1 nm";

  const std::array<std::pair<const char*, std::string>, 6> files{
      {{"paper.md", curves::paper_markdown(*tables, *samples, run, study::page_markdown(study::paper_survey_blocks()))},
       {"paper.json", curves::paper_json(*tables, *samples, study::paper_survey_json())},
       {"table1.csv", curves::table1_csv(*tables)},
       {"table2.csv", curves::table2_csv(*tables)},
       {"fig2.svg", curves::figure2_svg(samples->materials.front())},
       {"fig5e.svg", curves::figure5e_svg(*samples)}}};
  auto folder = core::OutputFolder::open(options.out);
  if (!folder) return tl::unexpected(folder.error());
  for (const auto& [name, bytes] : files) {
    if (const auto written = folder->write(name, bytes); !written) return written;
  }
  return folder->commit();
}

void add_paper_command(OptionList& program, const CommandContext& context) {
  OptionList command =
      program.add_command("paper", "compare the paper's tables, Fig. 2 and Fig. 5(e) with TouchAFM's values");
  // shared: the parser writes into it while it lives, the chosen command reads it afterwards
  const auto options = std::make_shared<PaperOptions>();
  command
      .add_option("--out", options->out,
                  "folder for paper.md, paper.json, the tables and the figures; created if it does not exist")
      .required()
      .type_name("DIR");
  command.add_option("--summary", options->summary_file, "summary.json of a demo; adds its measurements to the tables")
      .type_name("FILE");
  command.add_option("--materials", options->materials_file, "material file (TOML); default: the built-in file")
      .type_name("FILE");
  command.footer("example: touchafm paper --out paper --summary out/summary.json");
  command.when_chosen([options, &context] {
    if (options->materials_file.empty()) options->materials_file = context.assets_dir + "/materials.toml";
    auto done = write_paper(*options);
    if (done) core::log_line(fmt::format("open {}/paper.md", options->out));
    return done;
  });
}

}  // namespace afm::app
