// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/command.h"
#include "exhibit/exhibit_setup.h"
#include "scene/shared/shared_blocks.h"

namespace afm::app {

// --stereo, --swap-eyes and --ipd.
void add_stereo_options(CLI::App& command, exhibit::PictureOptions& options, const std::string& default_mode);

// --scale.
void add_scale_option(CLI::App& command, scene::ScaleMode& mode);

// --probe and --sample; and --sample alone, beside a --probe that knows names too.
void add_own_model_options(CLI::App& command, exhibit::ExhibitFiles& files);
void add_own_sample_option(CLI::App& command, exhibit::ExhibitFiles& files);

// --wall, --materials and --assets.
void add_stage_options(CLI::App& command, exhibit::ExhibitFiles& files, const app::CommandContext& context);

}  // namespace afm::app
