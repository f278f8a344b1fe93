// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/scan_subject.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "haptics/sample_surface.h"

namespace afm::exhibit {

namespace {

constexpr double kPlaneSideM = 500e-9;   // of a sample that has no relief
constexpr double kShareOfSample = 0.92;  // of the drawn sample's width that is scanned

// Bilinear between the vertices, level beyond the rim.
double height_m(const scene::SharedHeightField& field, double x_m, double y_m) {
  const auto along = [&](double place_m, std::uint32_t count) {
    return std::clamp(place_m / field.spacing_m + 0.5 * (count - 1.0), 0.0, count - 1.0);
  };
  const double u = along(x_m, field.columns), v = along(y_m, field.rows);
  const auto column = std::min(static_cast<std::uint32_t>(u), field.columns - 2);
  const auto row = std::min(static_cast<std::uint32_t>(v), field.rows - 2);
  const auto at = [&](std::uint32_t c, std::uint32_t r) {
    return static_cast<double>(field.height_m[std::size_t{r} * field.columns + c]);
  };
  const double low = std::lerp(at(column, row), at(column + 1, row), u - column);
  return std::lerp(low, std::lerp(at(column, row + 1), at(column + 1, row + 1), u - column), v - row);
}

}  // namespace

ScanSubject scan_subject(const WallScene& wall_scene, std::size_t material, const curves::SampleModel& model) {
  ScanSubject subject;
  subject.tip_radius_m = model.parameters.contact.tip_radius.si;
  subject.adhesion_n = std::abs(model.figures().force_before_joc.si);
  const std::uint32_t field = wall_scene.height_field(material);
  if (field == scene::kNoHeightField) {
    subject.side_m = kPlaneSideM;
    subject.drawn_m = [](double, double) { return 0.0; };
    subject.traced = [](double) { return [](double, double) { return 0.0; }; };
    return subject;
  }
  const auto drawn = std::make_shared<const scene::SharedHeightField>(wall_scene.height_fields()[field]);
  subject.side_m = kShareOfSample * drawn->spacing_m * (std::min(drawn->columns, drawn->rows) - 1.0);
  subject.drawn_m = [drawn](double x_m, double y_m) { return height_m(*drawn, x_m, y_m); };
  subject.traced = [drawn](double tip_radius_m) {
    constexpr double kAnyCurvature = std::numeric_limits<double>::infinity();
    const auto felt = std::make_shared<const haptics::SampleSurface>(*drawn, tip_radius_m, kAnyCurvature);
    return [felt](double x_m, double y_m) { return felt->at({x_m, y_m}).height_m; };
  };
  return subject;
}

}  // namespace afm::exhibit
