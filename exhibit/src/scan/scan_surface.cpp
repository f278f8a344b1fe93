// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/scan_surface.h"

#include <array>
#include <memory>
#include <utility>

#include "curves/sample_model.h"
#include "exhibit/models/drawn_surface.h"
#include "haptics/contact_model.h"
#include "haptics/simulated_device.h"
#include "physics/imaging/morphology.h"

namespace afm::exhibit {
namespace {

physics::HeightGrid grid_of(const scene::SharedHeightField& drawn) {
  physics::HeightGrid grid;
  grid.columns = drawn.columns;
  grid.rows = drawn.rows;
  grid.column_step_m = grid.row_step_m = drawn.spacing_m;
  grid.x_first_m = -0.5 * static_cast<double>(drawn.columns - 1) * drawn.spacing_m;
  grid.y_first_m = -0.5 * static_cast<double>(drawn.rows - 1) * drawn.spacing_m;
  grid.height_m.assign(drawn.height_m.begin(), drawn.height_m.begin() + std::ptrdiff_t{drawn.columns} * drawn.rows);
  return grid;
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
                                       const std::string& assets_dir) {
  const auto drawn = drawn_surface(assets_dir, setup.material);
  if (!drawn) return tl::unexpected(drawn.error());
  const auto material = curves::make_sample_model(setup);
  if (!material) return tl::unexpected(material.error());

  ScanSurface surface;
  surface.width_m = static_cast<double>((*drawn)->columns - 1) * (*drawn)->spacing_m;
  surface.depth_m = static_cast<double>((*drawn)->rows - 1) * (*drawn)->spacing_m;
  surface.pull_off_force_n = std::max(0.0, -material->figures().force_before_joc.si);
  surface.snap_in_m = std::max(0.0, material->figures().z_jtc.si);
  if (tip.kind == physics::TipKind::Paraboloid) {
    auto felt = felt_surface(*material, **drawn);
    if (!felt) return tl::unexpected(felt.error());
    surface.height_m = [felt = std::move(*felt)](double x_m, double y_m) { return felt.at({x_m, y_m}).height_m; };
    return surface;
  }
  physics::TipShape single = tip;
  single.second_apex_distance = physics::Length();
  surface.height_m = [traced = physics::image_of(grid_of(**drawn), single)](double x_m, double y_m) {
    return traced.height_at_m(x_m, y_m);
  };
  return surface;
}

}  // namespace afm::exhibit
