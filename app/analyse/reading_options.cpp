// SPDX-License-Identifier: Apache-2.0
#include "app/analyse/reading_options.h"

#include <string>
#include <utility>

#include "curves/table_columns.h"

namespace afm::app {

std::vector<NamedOption> add_reading_options(OptionList& command, curves::CurveReading& reading) {
  std::vector<NamedOption> added = add_calibration_options(command, reading);
  const auto read_columns = [&reading](const std::string& text) -> core::Result<void> {
    auto columns = curves::parse_table_columns(text);
    if (!columns) return tl::unexpected(columns.error());
    reading.columns = std::move(*columns);
    return {};
  };
  added.push_back(
      {command
           .add_parsed_option("--columns", read_columns,
                              "read FILE as a plain table, by the names and units of its columns: "
                              "\"height:um force:nN\", \"- height:nm deflection:V\", or deflection:-V where the "
                              "sign is the opposite; names: height, "
                              "force, deflection, retract-force, retract-deflection, segment, time, -")
           .type_name("COLUMNS"),
       "--columns"});
  return added;
}

}  // namespace afm::app
