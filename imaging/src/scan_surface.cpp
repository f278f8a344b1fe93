// SPDX-License-Identifier: Apache-2.0
#include "imaging/scan_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "curves/image_file.h"
#include "curves/sample_model.h"
#include "gratings.h"
#include "haptics/contact_model.h"
#include "haptics/simulated_device.h"
#include "imaging/drawn_surface.h"
#include "imaging/own_models.h"
#include "physics/imaging/morphology.h"
#include "physics/imaging/rim.h"
#include "scene/graph/height_field.h"

namespace afm::imaging {
namespace {

// Grid of a scene::SharedHeightField or a scene::Topography: centred on the origin, row by row from -y.
template <class Heights>
physics::HeightGrid grid_of(const Heights& heights) {
  physics::HeightGrid grid;
  grid.columns = heights.columns;
  grid.rows = heights.rows;
  grid.column_step_m = grid.row_step_m = heights.spacing_m;
  grid.x_first_m = -0.5 * static_cast<double>(heights.columns - 1) * heights.spacing_m;
  grid.y_first_m = -0.5 * static_cast<double>(heights.rows - 1) * heights.spacing_m;
  grid.height_m.assign(heights.height_m.begin(),
                       heights.height_m.begin() + std::ptrdiff_t{heights.columns} * heights.rows);
  return grid;
}

core::Result<physics::HeightGrid> measured_heights(const OwnSample& own) {
  const auto measured = curves::load_topography(own.file, own.reading);
  if (!measured) return tl::unexpected(measured.error());
  const auto heights = curves::felt_topography(*measured);
  if (!heights) return tl::unexpected(heights.error());
  return grid_of(*heights);
}

core::Result<std::unique_ptr<scene::SharedHeightField>> surface_of_model(const OwnSample& own) {
  if (const auto checked = check_own_sample(own.file); !checked) return tl::unexpected(checked.error());
  const auto model = load_own_sample(own.file);
  if (!model) return tl::unexpected(model.error());
  const auto node = model->find_node("surface");
  const auto field = node ? scene::height_field_below(*model, *node) : std::nullopt;
  if (!field) {
    return core::failure(core::ErrorCategory::BadInputFile,
                         fmt::format("cannot scan the sample '{}': its surface has no heights", own.file));
  }
  return std::make_unique<scene::SharedHeightField>(*field);
}

core::Result<haptics::SampleSurface> felt_surface(const curves::SampleModel& material,
                                                  const scene::SharedHeightField& drawn) {
  constexpr std::int64_t kServoPeriodNs = 1'000'000;
  const haptics::DeviceSpec device = haptics::SimulatedDevice().spec();
  const auto common = haptics::Scaling::common_scale(std::array{material.tables}, device);
  if (!common) return tl::unexpected(common.error());
  const auto contact =
      haptics::ContactModel::create(material.parameters, 0, material.tables, &drawn, *common, device, kServoPeriodNs);
  if (!contact) return tl::unexpected(contact.error());
  return (*contact)->surface();
}

}  // namespace

core::Result<ScanSurface> scan_surface(const curves::ContactSetup& setup, const physics::TipShape& tip,
                                       const std::string& assets_dir, const OwnSample& own) {
  const auto material = curves::make_sample_model(setup);
  if (!material) return tl::unexpected(material.error());
  ScanSurface surface;
  surface.pull_off_force_n = std::max(0.0, -material->figures().force_before_joc.si);
  surface.snap_in_m = std::max(0.0, material->figures().z_jtc.si);
  physics::TipShape single = tip;
  single.second_apex_distance = physics::Length();
  const auto level = [&](physics::HeightGrid grid) {
    surface.width_m = static_cast<double>(grid.columns - 1) * grid.column_step_m;
    surface.depth_m = static_cast<double>(grid.rows - 1) * grid.row_step_m;
    surface.height_m = physics::level_beyond_rim(std::make_shared<const physics::HeightGrid>(std::move(grid)));
  };
  if (is_gratings(own.file)) {
    level(physics::image_of(gratings(), single));
    return surface;
  }
  if (curves::is_image_file(own.file)) {
    auto measured = measured_heights(own);
    if (!measured) return tl::unexpected(measured.error());
    level(own.is_traced ? std::move(*measured) : physics::image_of(*measured, single));
    return surface;
  }

  const auto drawn = own.file.empty() ? drawn_surface(assets_dir, setup.material) : surface_of_model(own);
  if (!drawn) return tl::unexpected(drawn.error());
  level(grid_of(**drawn));
  if (tip.kind == physics::TipKind::Paraboloid) {
    auto felt = felt_surface(*material, **drawn);
    if (!felt) return tl::unexpected(felt.error());
    surface.height_m = [felt = std::move(*felt)](double x_m, double y_m) { return felt.at({x_m, y_m}).height_m; };
  } else {
    level(physics::image_of(grid_of(**drawn), single));
  }
  return surface;
}

}  // namespace afm::imaging
