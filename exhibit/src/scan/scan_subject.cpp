// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/scan_subject.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "exhibit/scenery/wall_scene.h"
#include "haptics/sample_surface.h"
#include "physics/imaging/height_grid.h"
#include "physics/imaging/morphology.h"
#include "physics/imaging/rim.h"
#include "physics/law_tables.h"
#include "physics/tapping/tap_surface.h"
#include "scene/shared/felt_heights.h"
#include "scene/shared/shared_segment.h"

namespace afm::exhibit {

namespace {

constexpr double kPlaneSideM = 500e-9;   // side for a sample without relief
constexpr double kShareOfSample = 0.92;  // scanned fraction of the drawn sample's width

// Grid of heights in metres as measured.
physics::HeightGrid grid_of(const scene::FeltHeights& heights, const scene::TopographyScale& shown) {
  const double spacing_m = heights.spacing_m / shown.lateral;
  physics::HeightGrid grid{.columns = heights.columns,
                           .rows = heights.rows,
                           .x_first_m = -0.5 * (heights.columns - 1.0) * spacing_m,
                           .y_first_m = -0.5 * (heights.rows - 1.0) * spacing_m,
                           .column_step_m = spacing_m,
                           .row_step_m = spacing_m,
                           .height_m = {heights.height_m.begin(), heights.height_m.end()}};
  for (double& height_m : grid.height_m) height_m *= heights.height_factor / shown.vertical;
  return grid;
}

// The image that a tip of another radius would have measured. Dilating the image of a paraboloid by a second paraboloid
// gives that of one whose radius is the sum of both. A sharper tip reveals nothing beyond the measurement.
std::function<physics::Scanner::Surface(double)> traced_again(std::shared_ptr<const physics::HeightGrid> measured,
                                                              double tip_radius_m) {
  return [measured = std::move(measured), tip_radius_m](double radius_m) {
    if (radius_m <= tip_radius_m) return physics::level_beyond_rim(measured);
    auto blunter = std::make_shared<physics::HeightGrid>(*measured);
    physics::dilate_by_paraboloid(*blunter, physics::Length(radius_m - tip_radius_m));
    return physics::level_beyond_rim(std::move(blunter));
  };
}

// Slope along the lines, ignoring the steepest percent of all places.
double slope_of(const physics::HeightGrid& grid) {
  constexpr double kOfPlaces = 0.99;
  std::vector<double> slopes;
  slopes.reserve(grid.height_m.size());
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t column = 1; column < grid.columns; ++column) {
      slopes.push_back(std::abs(grid.at(column, row) - grid.at(column - 1, row)) / std::abs(grid.column_step_m));
    }
  }
  if (slopes.empty()) return 0.0;
  const auto steep = slopes.begin() + static_cast<std::ptrdiff_t>(kOfPlaces * static_cast<double>(slopes.size() - 1));
  std::nth_element(slopes.begin(), steep, slopes.end());
  return *steep;
}

// Pull-off force of the sample under the lever at rest.
double pull_off_n(const curves::SampleModel& model) {
  if (!model.taps()) return std::abs(model.figures().force_before_joc.si);
  const scene::SharedContact& sample = model.parameters;
  return std::abs(
      physics::build_law_tables(sample.law, sample.contact, scene::law_options(sample))->figures.force_before_joc.si);
}

}  // namespace

ScanSubject scan_subject(const WallScene& wall_scene, std::size_t material, const curves::SampleModel& model) {
  ScanSubject subject;
  subject.tip_radius_m = model.parameters.contact.tip_radius.si;
  subject.adhesion_n = pull_off_n(model);
  if (model.taps()) {
    const scene::SharedContact& sample = model.parameters;
    subject.tapped = TappedSubject{
        .surface = std::make_shared<const physics::TapSurface>(sample.law, sample.contact, scene::law_options(sample),
                                                               physics::Viscosity(sample.viscosity_pa_s)),
        .lever = scene::tapping_lever(sample),
        .rests = model.tables->taps};
  }
  scene::SharedContact laid;
  wall_scene.lay_surface_on(laid, material);
  const double scale = scene::surface_scale(laid, model.scaling.release_z_m());
  scene::FeltHeights heights = scene::surface_of(laid, wall_scene.height_fields(), wall_scene.topography());
  if (heights.columns == 0) {
    subject.side_m = kPlaneSideM;
    subject.drawn_m = [](double, double) { return 0.0; };
    subject.traced = [](double) { return [](double, double) { return 0.0; }; };
    return subject;
  }
  // a measured sample keeps its own metres whatever the size at which it is shown
  const bool measured = heights.heights == scene::Heights::Traced;
  if (!measured) heights = heights.scaled(scale);
  auto grid = std::make_shared<const physics::HeightGrid>(
      grid_of(heights, measured ? laid.topography : scene::TopographyScale{}));
  if (measured) subject.shown = {scale * laid.topography.lateral, scale * laid.topography.vertical};
  subject.side_m = kShareOfSample * grid->column_step_m * (std::min(heights.columns, heights.rows) - 1.0);
  subject.drawn_m = physics::level_beyond_rim(grid);
  if (measured) {
    subject.slope = slope_of(*grid);
    subject.traced = traced_again(std::move(grid), subject.tip_radius_m);
    return subject;
  }
  const auto drawn = std::make_shared<const scene::SharedHeightField>(wall_scene.height_fields()[laid.height_field]);
  subject.traced = [drawn, scale](double tip_radius_m) {
    constexpr double kAnyCurvature = std::numeric_limits<double>::infinity();
    const auto felt = std::make_shared<const haptics::SampleSurface>(scene::FeltHeights(*drawn).scaled(scale),
                                                                     tip_radius_m, kAnyCurvature);
    return [felt](double x_m, double y_m) { return felt->at({x_m, y_m}).height_m; };
  };
  return subject;
}

}  // namespace afm::exhibit
