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

// An image from a file, levelled. `file` keeps the raw values.
struct MeasuredTopography {
  std::string name;  // name of the file
  LoadedImage file;
  physics::HeightStatistics raw;  // statistics of the selected channel
  physics::Levelling levelling = physics::Levelling::Plane;
  physics::LevelledHeights level;
  physics::HeightStatistics levelled;

  const physics::ImageChannel& channel() const { return file.image.channels[file.chosen]; }
};

// BadInputFile as from load_image(), and if no point was measured.
core::Result<MeasuredTopography> load_topography(const std::string& path, const TopographyReading& reading);

// One line each for file, channels, size, mean, Sq and levelling, with units.
std::string topography_text(const MeasuredTopography& topography);

// Topography as JSON in SI.
nlohmann::ordered_json topography_json(const MeasuredTopography& topography);

// The levelled heights to feel and draw, 0 at the origin. They are the image's points if its pixels are square and no
// side exceeds scene::kMaxTopographySide; otherwise the image is averaged and resampled. BadInputFile for a channel
// that is not a height, larger than any scanner's range, or smaller than an atom.
core::Result<scene::Topography> felt_topography(const MeasuredTopography& topography);

}  // namespace afm::curves
