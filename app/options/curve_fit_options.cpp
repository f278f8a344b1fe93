// SPDX-License-Identifier: Apache-2.0
#include "app/options/curve_fit_options.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "app/options/enum_option.h"
#include "app/options/quantity_option.h"
#include "curves/lever/lever_inputs.h"
#include "curves/table_columns.h"
#include "physics/contact_parameters.h"
#include "physics/quantity_text.h"

namespace afm::app {

namespace {

// Range of spring constants, as for a contact.
constexpr QuantityRange<physics::Stiffness> kSpringConstants{physics::Stiffness(1e-6), physics::Stiffness(1e6)};

}  // namespace

core::Result<double> parse_sensitivity(std::string_view text) {
  const auto parsed =
      physics::parse_si(text, "a sensitivity", curves::lever_units::kSensitivities, physics::Infinity::Refused);
  if (const auto* error = std::get_if<std::string>(&parsed)) return core::wrong_usage(*error);
  const double m_per_v = std::get<double>(parsed);
  if (!(m_per_v > 0.0))
    return core::wrong_usage(fmt::format("\"{}\" is not above 0, as a deflection per volt is", text));
  return m_per_v;
}

core::Result<physics::Stiffness> parse_spring_constant(std::string_view text) {
  constexpr physics::ContactField kField = physics::contact_field("spring_constant");
  const auto parsed = physics::parse_quantity(text, physics::kStiffnessUnits);
  if (!parsed.value) return core::wrong_usage("--spring-constant: " + parsed.error);
  if (parsed.value->si >= kField.smallest && parsed.value->si <= kField.largest) return *parsed.value;
  return core::wrong_usage(fmt::format("--spring-constant: \"{}\" is not within {}", text, kField.range()));
}

NamedOption add_sensitivity_option(OptionList& command, curves::CurveReading& reading) {
  const auto read_sensitivity = [&reading](const std::string& text) -> core::Result<void> {
    const auto sensitivity = parse_sensitivity(text);
    if (!sensitivity) return tl::unexpected(sensitivity.error());
    reading.sensitivity_m_per_v = *sensitivity;
    return {};
  };
  return {command
              .add_parsed_option("--sensitivity", read_sensitivity,
                                 "sensitivity of the optical lever instead of the file's")
              .type_name("SENSITIVITY in um/V, nm/V, pm/V"),
          "--sensitivity"};
}

NamedOption add_columns_option(OptionList& command, curves::CurveReading& reading) {
  const auto read_columns = [&reading](const std::string& text) -> core::Result<void> {
    auto columns = curves::parse_table_columns(text);
    if (!columns) return tl::unexpected(columns.error());
    reading.columns = std::move(*columns);
    return {};
  };
  return {command
              .add_parsed_option("--columns", read_columns,
                                 "read FILE as a plain table, by the names and units of its columns: "
                                 "\"height:um force:nN\", \"- height:nm deflection:V\", or deflection:-V where the "
                                 "sign is the opposite; names: height, "
                                 "tip-position (the separation of other programs), force, deflection; for a way back "
                                 "beside the approach retract-height, retract-tip-position, retract-force, "
                                 "retract-deflection; segment, time, -")
              .type_name("COLUMNS"),
          "--columns"};
}

std::vector<NamedOption> add_calibration_options(OptionList& command, curves::CurveReading& reading) {
  std::vector<NamedOption> added;
  const auto add = [&added](const char* name, const Option& option) { added.push_back({option, name}); };
  add("--spring-constant",
      quantity_option(
          command, "--spring-constant", [&reading](physics::Stiffness lever) { reading.spring_constant = lever; },
          physics::kStiffnessUnits, "spring constant of the lever instead of the file's; forces scale with it",
          std::optional(kSpringConstants)));
  added.push_back(add_sensitivity_option(command, reading));
  return added;
}

std::vector<NamedOption> add_shape_options(OptionList& command, curves::FitOptions& options, const std::string& help) {
  std::string shapes;
  for (const fits::ShapeRow& row : fits::kShapes) shapes += fmt::format("\n  {}: {}", row.name, row.meaning);
  std::vector<NamedOption> added;
  const auto add = [&added](const std::string& name, const Option& option) { added.push_back({option, name}); };
  add("--fit", enum_option(command, "--fit", options.shape, "a shape of the tip", fits::kShapes, &fits::ShapeRow::name,
                           &fits::ShapeRow::shape, help + shapes));
  for (const curves::FitNumber& number : curves::fit_numbers()) {
    const std::string name = fmt::format("--{}", number.name);
    add(name, si_option(
                  command, name, [&options, set = number.set](double si) { set(options, si); }, number.domain,
                  std::string(number.help)));
  }
  add("--base",
      enum_option(command, "--base", options.base, "a base", fits::kBases, &fits::BaseName::name, &fits::BaseName::base,
                  "of --fit layer-exact-...: how the layer lies on it; default: bonded"));
  return added;
}

}  // namespace afm::app
