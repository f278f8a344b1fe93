// SPDX-License-Identifier: Apache-2.0
#include "app/analyse/reading_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "app/options/quantity_option.h"
#include "curves/table_columns.h"
#include "physics/quantity_text.h"

namespace afm::app {

namespace {

using core::wrong_usage;

// The same range as for a contact.
constexpr QuantityRange<physics::Stiffness> kSpringConstants{physics::Stiffness(1e-6), physics::Stiffness(1e6)};

}  // namespace

core::Result<double> parse_sensitivity(std::string_view text) {
  constexpr std::string_view kPerVolt = "/V";
  const auto parsed = physics::parse_quantity(text.substr(0, text.size() - std::min(text.size(), kPerVolt.size())),
                                              physics::kLengthUnits);
  if (!text.ends_with(kPerVolt) || !parsed.value || parsed.value->si <= 0.0) {
    return wrong_usage(fmt::format("\"{}\" is not a deflection per volt, such as 70nm/V", text));
  }
  return parsed.value->si;
}

std::vector<NamedOption> add_reading_options(OptionList& command, curves::CurveReading& reading) {
  std::vector<NamedOption> added;
  const auto add = [&added](const char* name, const Option& option) { added.push_back({option, name}); };
  add("--spring-constant",
      quantity_option(
          command, "--spring-constant", [&reading](physics::Stiffness lever) { reading.spring_constant = lever; },
          physics::kStiffnessUnits, "spring constant of the lever instead of the file's; forces scale with it",
          std::optional(kSpringConstants)));
  const auto read_sensitivity = [&reading](const std::string& text) -> core::Result<void> {
    const auto sensitivity = parse_sensitivity(text);
    if (!sensitivity) return tl::unexpected(sensitivity.error());
    reading.sensitivity_m_per_v = *sensitivity;
    return {};
  };
  add("--sensitivity", command
                           .add_parsed_option("--sensitivity", read_sensitivity,
                                              "sensitivity of the optical lever instead of the file's")
                           .type_name("SENSITIVITY in um/V, nm/V, pm/V"));
  const auto read_columns = [&reading](const std::string& text) -> core::Result<void> {
    auto columns = curves::parse_table_columns(text);
    if (!columns) return tl::unexpected(columns.error());
    reading.columns = std::move(*columns);
    return {};
  };
  add("--columns",
      command
          .add_parsed_option("--columns", read_columns,
                             "read FILE as a plain table, by the names and units of its columns: "
                             "\"height:um force:nN\", \"- height:nm deflection:V\", or deflection:-V where the "
                             "sign is the opposite; names: height, "
                             "force, deflection, retract-force, retract-deflection, segment, time, -")
          .type_name("COLUMNS"));
  return added;
}

}  // namespace afm::app
