// SPDX-License-Identifier: Apache-2.0
#include "synthetic_truth.h"

#include <array>
#include <nlohmann/json.hpp>

#include "core/enumerators.h"
#include "core/written_by.h"

namespace afm::curves {

namespace {

using json = nlohmann::ordered_json;

// Equation of docs/fits.md and its publication.
struct LawSource {
  fits::Shape shape;
  std::string_view equation, source;
};
constexpr std::array kLawSources{
    LawSource{fits::Shape::Paraboloid, "F1", "Hertz, J. reine angew. Math. 92, 156 (1881)"},
    LawSource{fits::Shape::Sphere, "F2", "Sneddon, Int. J. Eng. Sci. 3, 47 (1965)"},
    LawSource{fits::Shape::Cone, "F3", "Sneddon, Int. J. Eng. Sci. 3, 47 (1965)"},
    LawSource{fits::Shape::Pyramid3, "F3 with 0.8887", "nanite 4.2"},
    LawSource{fits::Shape::Pyramid4Bilodeau, "F3 with 0.7453", "Bilodeau, J. Appl. Mech. 59, 519 (1992)"},
    LawSource{fits::Shape::Pyramid4Rico, "F3 with 0.7071", "Rico and others, Phys. Rev. E 72, 021914 (2005)"},
    LawSource{fits::Shape::LayerSphere, "F4", "Garcia & Garcia, Biophys. J. 114, 2923 (2018)"},
    LawSource{fits::Shape::LayerCone, "F5", "Garcia & Garcia, Biophys. J. 114, 2923 (2018)"},
    LawSource{fits::Shape::LayerExactSphere, "F9", "Lebedev & Ufliand 1958; Hayes and others 1972"},
    LawSource{fits::Shape::LayerExactCone, "F9", "Lebedev & Ufliand 1958; Hayes and others 1972"},
    LawSource{fits::Shape::LayerDimitriadis, "F6", "Dimitriadis and others, Biophys. J. 82, 2798 (2002)"},
    LawSource{fits::Shape::Dmt, "F10", "Derjaguin, Muller & Toporov 1975"},
    LawSource{fits::Shape::Jkr, "F11", "Johnson, Kendall & Roberts 1971"},
    LawSource{fits::Shape::Maugis, "F12", "Maugis 1992"},
    LawSource{fits::Shape::Auto, "", ""}};
static_assert(core::has_row_for_each(kLawSources, &LawSource::shape));

}  // namespace

json truth_of(const SyntheticSetup& setup, std::string_view kind) {
  const LawSource& law = kLawSources[static_cast<std::size_t>(setup.shape)];
  json truth{{"kind", kind}};
  core::name_software(truth);
  truth["seed"] = setup.seed;
  truth["law"] = fits::row_of(setup.shape).name;
  truth["equation"] = law.equation;
  truth["source"] = law.source;
  truth["signs"] =
      "z is the height of the lever's base, contact_z_m that at which the undeformed tip meets the undeformed sample; "
      "force on the tip positive away from the sample";
  if (fits::row_of(setup.shape).is_exact) {
    truth["base"] = fits::kBases[static_cast<std::size_t>(setup.base)].name;
  }
  truth["points_per_branch"] = setup.points;
  json& parameters = truth["parameters"] = json::object();
  for (const SyntheticField& field : kSyntheticFields) {
    const double si = setup.*field.member;
    const bool is_set = si != 0.0 || field.smallest <= 0.0;  // false: zero in a field that must be positive
    if (is_set && field.use(setup) != FieldUse::None) parameters[std::string(field.json_key)] = si;
  }
  truth["curves"] = json::array();
  return truth;
}

CurvePosition centre_of(const MapPixel& pixel) {
  const MapGrid& grid = pixel.grid;
  const auto along = [](std::size_t index, std::size_t count) {
    return (static_cast<double>(index) + 0.5) / static_cast<double>(count) - 0.5;
  };
  return {grid.center_x_m + grid.width_m * along(pixel.column, grid.columns),
          grid.center_y_m + grid.height_m * along(pixel.row, grid.rows)};
}

void add_map(const SyntheticMap& map, const std::vector<RecordedCurve>& curves, json& truth) {
  json field{{"columns", map.grid.columns},
             {"rows", map.grid.rows},
             {"width_m", map.grid.width_m},
             {"height_m", map.grid.height_m},
             {"field", kFieldShapes[static_cast<std::size_t>(map.shape)].name},
             {"order", "row by row from the bottom, each from the left"}};
  if (map.second_modulus_pa > 0.0) field["second_modulus_Pa"] = map.second_modulus_pa;
  if (map.second_work_j_per_m2 > 0.0) field["second_work_of_adhesion_J_per_m2"] = map.second_work_j_per_m2;
  for (const char* key : {"modulus_Pa", "work_of_adhesion_J_per_m2"}) {
    if (!truth["curves"].front().contains(key)) continue;
    json& rows = field[key] = json::array();
    for (std::size_t index = 0; index < curves.size(); ++index) {
      if (index % map.grid.columns == 0) rows.push_back(json::array());
      rows.back().push_back(truth["curves"][index][key]);
    }
  }
  for (std::size_t index = 0; index < curves.size(); ++index) {
    const CurveMetadata& metadata = curves[index].metadata;
    json& curve = truth["curves"][index];
    curve["column"] = metadata.pixel->column;
    curve["row"] = metadata.pixel->row;
    curve["x_m"] = metadata.position->x_m;
    curve["y_m"] = metadata.position->y_m;
  }
  truth["map"] = std::move(field);
}

}  // namespace afm::curves
