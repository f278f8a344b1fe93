// SPDX-License-Identifier: Apache-2.0
#include "app/analyse/fit_options.h"

#include <fmt/format.h>

#include <string>

#include "app/options/enum_option.h"
#include "app/options/quantity_option.h"
#include "app/options/uncertainty_option.h"

namespace afm::app {

std::vector<NamedOption> add_fit_options(OptionList& command, curves::FitOptions& options) {
  std::string shapes;
  for (const fits::ShapeRow& row : fits::kShapes) shapes += fmt::format("\n  {}: {}", row.name, row.meaning);
  std::vector<NamedOption> added;
  const auto add = [&added](const std::string& name, const Option& option) { added.push_back({option, name}); };
  add("--fit",
      enum_option(command, "--fit", options.shape, "a shape of the tip", fits::kShapes, &fits::ShapeRow::name,
                  &fits::ShapeRow::shape,
                  "fit the elastic modulus to the approach, or with the work of adhesion to both branches:" + shapes));
  for (const curves::FitNumber& number : curves::fit_numbers()) {
    const std::string name = fmt::format("--{}", number.name);
    add(name, si_option(
                  command, name, [&options, set = number.set](double si) { set(options, si); }, number.domain,
                  std::string(number.help)));
  }
  add("--base",
      enum_option(command, "--base", options.base, "a base", fits::kBases, &fits::BaseName::name, &fits::BaseName::base,
                  "with --fit layer-exact-...: contact of layer and base; default: bonded"));
  add("--uncertainty",
      uncertainty_option(command, options.uncertainty_texts, "radius=5%",
                         "with --fit: relative standard deviation of an input, such as radius=5%, for the "
                         "systematic part of the results, separate from the interval; repeatable; keys: "
                         "spring-constant, sensitivity, radius, half-angle, layer, poisson"));
  add("--against",
      enum_option(command, "--against", options.against, "a variable", fits::kAgainst, &fits::AgainstName::name,
                  &fits::AgainstName::against,
                  "with --fit: z, the height of the lever's base, or tip, the tip position of nanite and AtomicJ; "
                  "default: z"));
  add("--tilt", command.add_flag("--tilt", options.tilt, "with --fit: also fit a tilt of the baseline"));
  add("--white-noise", command.add_flag("--white-noise", options.white,
                                        "with --fit: assume white noise, as nanite and AtomicJ do; for other "
                                        "noise the interval is then too narrow"));
  return added;
}

}  // namespace afm::app
