// SPDX-License-Identifier: Apache-2.0
#include "app/options/contact_options.h"

#include <string>

#include "app/options/quantity_option.h"

namespace afm::app {

void add_contact_options(OptionList& command, curves::ContactOptions& options, const CommandContext& context) {
  options.assets_dir = context.assets_dir;
  command
      .add_option("--materials", options.material_files,
                  "your own material file (TOML); repeatable; adds to the built-in materials; a material with the same "
                  "name replaces the built-in one")
      .type_name("FILE")
      .one_value_each();
  const Option probe =
      command
          .add_option("--probe", options.probe,
                      "name of a probe whose lever and tip replace the material's; touchafm material lists the probes")
          .type_name("PROBE");
  command
      .add_option("--probes", options.probe_files,
                  "your own probe file (TOML); repeatable; adds to the built-in probes")
      .needs(probe)
      .type_name("FILE")
      .one_value_each();
  command
      .add_option("--model", options.model,
                  "law of force; auto chooses it by the contact's Tabor parameter; one of " +
                      curves::known_models(curves::ModelUse::Curve))
      .type_name("MODEL")
      .show_default();
  for (const curves::ContactParameter& parameter : curves::contact_parameters()) {
    command
        .add_option("--" + std::string(parameter.option), options.values[std::string(parameter.option)],
                    std::string(parameter.help))
        .type_name(type_word(parameter.sort));
  }
  command.add_flag("--exact-sphere", options.exact_sphere,
                   "use Hamaker's exact sphere formula, not Derjaguin's approximation");
}

}  // namespace afm::app
