// SPDX-License-Identifier: Apache-2.0
#include "app/analyse/fit_options.h"

#include "app/options/enum_option.h"
#include "app/options/uncertainty_option.h"

namespace afm::app {

std::vector<NamedOption> add_fit_options(OptionList& command, curves::FitOptions& options) {
  std::vector<NamedOption> added = add_shape_options(
      command, options, "fit the elastic modulus to the approach, or with the work of adhesion to both branches:");
  const auto add = [&added](const char* name, const Option& option) { added.push_back({option, name}); };
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
  add("--bootstrap",
      command.add_flag("--bootstrap", options.bootstrap,
                       "with --fit: also give intervals by a moving-block bootstrap, 200 more fits of each "
                       "curve to resampled residuals"));
  return added;
}

}  // namespace afm::app
