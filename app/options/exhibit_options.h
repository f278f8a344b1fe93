// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/options/command.h"
#include "app/options/curve_fit_options.h"
#include "exhibit/frame/exhibit_files.h"
#include "exhibit/frame/wall_pictures.h"
#include "physics/friction/friction.h"
#include "scene/samples/level_choice.h"
#include "scene/shared/scale_modes.h"

namespace afm::app {

// Adds --stereo, --swap-eyes and --ipd.
void add_stereo_options(OptionList& command, exhibit::PictureOptions& options, const std::string& default_mode);

// Adds --gpu.
Option add_gpu_option(OptionList& command, std::string& gpu);

// Adds --probe and --sample; the second function adds only --sample, for a command whose --probe also accepts names.
// With `particles`, --level also takes their level, and --seed is added.
void add_own_model_options(OptionList& command, exhibit::ExhibitFiles& files, scene::LevelChoice* particles = nullptr);
void add_own_sample_option(OptionList& command, exhibit::ExhibitFiles& files, scene::LevelChoice* particles = nullptr);

// Adds --particles.
void add_particles_option(OptionList& command, exhibit::ExhibitFiles& files);

// Adds --force-map, --pixel, and the options for how its curves are read and fitted, which are returned.
std::vector<NamedOption> add_force_map_options(OptionList& command, exhibit::ExhibitFiles& files);

// Sets the lever of the force map's curves, replacing the file's. WrongUsage for a text that is no spring constant.
core::Result<void> set_map_spring_constant(const std::string& text, exhibit::ExhibitFiles& files);

// Adds --scale.
void add_scale_option(OptionList& command, std::optional<scene::ScaleMode>& mode);

// Adds --friction.
void add_friction_option(OptionList& command, physics::FrictionLaw& friction);

// Adds --language, --guidance and --assets, which determine the texts of pictures and reports.
void add_phrase_options(OptionList& command, exhibit::ExhibitFiles& files, const CommandContext& context);

// Adds --wall.
Option add_wall_option(OptionList& command, exhibit::ExhibitFiles& files);

// Adds the options of the phrases, --wall and --materials.
void add_stage_options(OptionList& command, exhibit::ExhibitFiles& files, const CommandContext& context);

}  // namespace afm::app
