// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/result.h"
#include "curves/image_file.h"
#include "physics/imaging/levelling.h"
#include "scene/shared/felt_heights.h"

namespace afm::curves {

struct TopographyReading {
  ImageReading image;
  physics::Levelling levelling = physics::Levelling::Plane;
};

// An image of a file as it was measured, and levelled. The raw values stay in `file`.
struct MeasuredTopography {
  std::string name;  // name of the file
  LoadedImage file;
  physics::HeightStatistics raw;  // statistics of the selected channel
  physics::Levelling levelling = physics::Levelling::Plane;
  physics::LevelledHeights level;
  physics::HeightStatistics levelled;

  const physics::ImageChannel& channel() const { return file.image.channels[file.chosen]; }
};

// BadInputFile as load_image(), and where no point was measured.
core::Result<MeasuredTopography> load_topography(const std::string& path, const TopographyReading& reading);

// File, channels, size, mean, Sq and the levelling, a line each with its unit.
std::string topography_text(const MeasuredTopography& topography);

// The same in SI.
nlohmann::ordered_json topography_json(const MeasuredTopography& topography);

// The levelled heights as they are felt and drawn, 0 at the origin. They are the image's points one by one where its
// pixels are square and no side has more than scene::kMaxTopographySide; else the image is resampled, the mean of
// neighbours first. BadInputFile for a channel that is no height, larger than a scanner is, or smaller than
// an atom.
core::Result<scene::Topography> felt_topography(const MeasuredTopography& topography);

}  // namespace afm::curves
