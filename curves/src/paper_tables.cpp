// SPDX-License-Identifier: Apache-2.0
#include "curves/paper_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/whole_file.h"
#include "physics/contact.h"
#include "physics/force_curve.h"

namespace afm::curves {
namespace {

constexpr std::string_view kSwapped = "swapped columns";
constexpr std::string_view kRounded = "rounded terms";
constexpr std::string_view kPi = "pi = 3.14";
constexpr std::string_view kSlip = "slip in Table 2";

constexpr std::array kErrata{
    Erratum{kSwapped,
            "Table 1 prints the columns D_attr and (delta_c)_attr of mica and gold in each other's place. By (3.8) and "
            "(3.9) D_attr = 2 alpha (delta_c)_attr, so the gap is the larger one. Their sum is not touched as long as "
            "alpha = 1."},
    Erratum{kRounded,
            "Table 1 rounds D_attr and (delta_c)_attr before it adds them to Z_jtc: 4.071 nm for gold and 2.501 nm for "
            "silicon nitride, where (3.6) gives 4.0716 nm and exactly 2.5 nm; (delta_c)_attr of silicon nitride is "
            "5/6 nm = 0.833 nm, not 0.834 nm."},
    Erratum{kPi, "F_ad, and with it Z_joc, is computed with pi = 3.14: every one is 0.0507 % too small."},
    Erratum{kSlip,
            "Table 2 prints 0.2387 nN for the calculated F_attr of mica; (3.10) gives 0.2398 nN. Most likely 2.397 nm "
            "was read as 2.387 nm, so that the printed difference of -0.54 % should be -0.10 %."},
    Erratum{"circular adhesion",
            "The agreement of F_ad with the experiment is circular: sqrt(gamma_s gamma_t) = F_exp/(4 pi R) gives the "
            "three surface energies of Table 1 to the last digit. Only F_attr is a prediction."},
    Erratum{"sampled simulation",
            "The column Simulation of Table 2 falls short of the calculation by the distance that the hand moved "
            "between two samples, up to 0.10 nm at the jump to contact and 0.39 nm at the jump off contact. That is "
            "sampling error, not physics: a latch that finds the crossing inside the tick does not have it."},
    Erratum{
        "pull after the jump",
        "(3.10) is the pull of the lever just after the jump, with the tip on the surface: the pull-on force. Just "
        "before it the attraction is k_c (delta_c)_attr = A R/(6 D^2), a third of it. A tip that lands at an atomic "
        "distance from the surface instead of on it pulls 7 to 18 % less than (3.10) says."},
    Erratum{"signs",
            "(3.2) and (3.4) are negative, (3.10) and the tables positive, and (3.1) makes compression negative. "
            "With the sign of (3.4), Z_joc = F_ad/k' would lie below the surface. TouchAFM counts a force on the tip "
            "positive away from the sample; tables show magnitudes."},
    Erratum{"no equation for Z_joc", "Section 3.2 does not say how Z_joc follows: it is F_ad/k'."},
    Erratum{"finite sample stiffness",
            "The paper assumes k_s >> k_c and keeps alpha in its formulas. With a finite k_s, k' = k_c/alpha must "
            "stand in (3.10) and in Z_joc. The assumption holds for the three samples, whose contacts are 104, 248 and "
            "146 N/m stiff: alpha - 1 is 0.001 and less. It fails for soft samples and stiff levers; and no contact "
            "stiffness exists before there is contact, so that only an elastic support moves the fold."},
    Erratum{"gold's Hamaker constant",
            "12e-20 J is cited for SiO2 and gold and used for Si3N4 and gold. Combining relations give 3.4e-20 J for "
            "the first and 11e-20 J for the second: the value suits the tip that is simulated."},
    Erratum{"spring constant", "The text gives 0.1 to 0.3 N/m; silicon nitride uses 0.036 N/m."},
    Erratum{"direction rule",
            "Between Z_jtc and Z_joc the flow chart decides by the direction of motion: it pulls on a tip that has "
            "never touched or that rests, lets go of one that adheres, and chatters under noise. Z = Z_jtc is in none "
            "of its branches. TouchAFM latches; --model paper-rule shows the difference."},
    Erratum{"letters of the stages",
            "DE names the jump of Fig. 2, then a part of DF, then all of Z < Z_jtc. TouchAFM keeps the letters of the "
            "figure."},
    Erratum{"gold's experiment",
            "The classic curves on gold were taken with a tungsten carbide tip; the experiment in Table 2 may not be "
            "one with Si3N4."},
    Erratum{
        "van der Waals alone",
        "In water the electric double layer and hydration act too, the first beyond its screening length. The model "
        "leaves them out."},
    Erratum{"Derjaguin's approximation",
            "(3.8) takes the sphere for a paraboloid. Hamaker's sphere of 50 nm jumps nearer to the surface: Z_jtc by "
            "1.0 % for mica, 1.7 % for gold and 1.1 % for silicon nitride (--exact-sphere)."}};

struct PrintedTable1 {
  std::string_view quantity;
  std::string_view unit;
  double per_si;
  std::array<std::string_view, 3> printed;
  std::array<std::string_view, 3> erratum;
};

constexpr std::array<std::string_view, 3> kMaterials{"mica", "gold", "si3n4"};

// Rows of Liu & Peng, Table 1, that are computed from the others.
constexpr std::array kTable1{
    PrintedTable1{"D_attr", "nm", 1e9, {"0.799", "1.357", "1.667"}, {kSwapped, kSwapped, ""}},
    PrintedTable1{"delta_c_attr", "nm", 1e9, {"1.598", "2.714", "0.834"}, {kSwapped, kSwapped, kRounded}},
    PrintedTable1{"Z_jtc", "nm", 1e9, {"2.397", "4.071", "2.501"}, {kRounded, kRounded, kRounded}},
    PrintedTable1{"F_attr", "nN", 1e9, {"0.240", "0.407", "0.090"}, {"", "", ""}},
    PrintedTable1{"F_ad", "nN", 1e9, {"1.3992", "9.9946", "0.5997"}, {kPi, kPi, kPi}},
    PrintedTable1{"Z_joc", "nm", 1e9, {"13.992", "99.946", "16.658"}, {kPi, kPi, kPi}}};

struct PrintedTable2 {
  std::string_view material;
  std::string_view quantity;
  std::string_view calculation;
  std::string_view simulation;
  std::string_view erratum;
};

// Liu & Peng, Table 2; its experimental values are in the material file.
constexpr std::array kTable2{PrintedTable2{"mica", "F_attr", "0.2387", "0.23019", kSlip},
                             PrintedTable2{"mica", "F_ad", "1.3992", "1.39877", kPi},
                             PrintedTable2{"gold", "F_attr", "0.4071", "0.39962", kRounded},
                             PrintedTable2{"gold", "F_ad", "9.9946", "9.99359", kPi},
                             PrintedTable2{"si3n4", "F_attr", "0.09", "0.08815", ""},
                             PrintedTable2{"si3n4", "F_ad", "0.5997", "0.58551", kPi}};

double exact_si(const physics::ApproachRetractEvents& events, std::string_view quantity) {
  if (quantity == "D_attr") return events.d_attr.si;
  if (quantity == "delta_c_attr") return events.delta_c_attr.si;
  if (quantity == "Z_jtc") return events.z_jtc.si;
  if (quantity == "F_attr") return events.f_attr.si;
  if (quantity == "F_ad") return events.f_ad.si;
  return events.z_joc.si;
}

std::optional<double> measured_in(const MeasuredEvents& measured, std::string_view material, std::string_view quantity,
                                  double per_si) {
  const auto events = measured.find(std::string(material));
  if (events == measured.end()) return std::nullopt;
  const auto value = events->second.find(std::string(quantity));
  if (value == events->second.end()) return std::nullopt;
  return value->second * per_si;
}

std::vector<InputRow> input_rows(const scene::MaterialLibrary& library) {
  constexpr std::array<std::array<const char*, 2>, 4> kKeys{{{"R", "tip_radius"},
                                                             {"k' = k_c", "spring_constant"},
                                                             {"A_H", "hamaker"},
                                                             {"sqrt(gamma_s gamma_t)", "mean_surface_energy"}}};
  std::vector<InputRow> rows{{"tip", {}}, {"medium", {}}};
  for (const std::string_view name : kMaterials) {
    rows[0].values.push_back(library.find(name)->tip);
    rows[1].values.push_back(library.find(name)->medium);
  }
  for (const auto& [symbol, key] : kKeys) {
    InputRow row{symbol, {}};
    for (const std::string_view name : kMaterials) {
      for (const auto& sourced : library.find(name)->sources) {
        if (sourced.key == key) row.values.push_back(sourced.value);
      }
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

std::span<const Erratum> errata() { return kErrata; }

int erratum_number(std::string_view name) {
  const auto at = std::find_if(kErrata.begin(), kErrata.end(), [&](const Erratum& e) { return e.name == name; });
  return at == kErrata.end() ? 0 : static_cast<int>(at - kErrata.begin()) + 1;
}

core::Result<MeasuredEvents> load_measured_events(const std::string& path) {
  const auto bytes = core::read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  const auto bad = [&](const std::string& what) {
    return core::failure(core::ErrorCategory::BadInputFile, fmt::format("summary {}: {}", path, what));
  };
  const auto root = nlohmann::json::parse(*bytes, nullptr, false);
  if (!root.is_object() || !root.contains("materials") || !root["materials"].is_object()) {
    return bad("is not the summary.json of a demo: it has no object \"materials\"");
  }
  constexpr std::array<std::array<const char*, 2>, 4> kKeys{
      {{"f_attr_N", "F_attr"}, {"f_ad_N", "F_ad"}, {"z_jtc_m", "Z_jtc"}, {"z_joc_m", "Z_joc"}}};
  MeasuredEvents measured;
  for (const auto& [material, events] : root["materials"].items()) {
    for (const auto& [key, quantity] : kKeys) {
      if (!events.is_object() || !events.contains(key) || !events[key].is_number()) {
        return bad(fmt::format("materials.{}.{} is missing or not a number", material, key));
      }
      measured[material][quantity] = events[key].get<double>();
    }
  }
  return measured;
}

MeasuredEvents measured_events(const scene::MaterialLibrary& library) {
  constexpr physics::Length kStep(0.1e-9);
  MeasuredEvents measured;
  for (const scene::MaterialEntry& material : library.materials) {
    const physics::ApproachRetractModel model(material.contact);
    const auto curve = physics::record_curve(model, {1.2 * model.figures().z_joc, physics::Length(-5e-9), kStep});
    auto& events = measured[material.name];
    for (const physics::ModelEvent& event : curve.events) {
      const bool in = event.kind == physics::EventKind::JumpToContact;
      events[in ? "Z_jtc" : "Z_joc"] = event.z.si;
      events[in ? "F_attr" : "F_ad"] = std::abs((in ? event.force_after : event.force_before).si);
    }
  }
  return measured;
}

core::Result<PaperTables> paper_tables(const scene::MaterialLibrary& library, const MeasuredEvents& measured) {
  PaperTables tables;
  std::map<std::string_view, physics::ApproachRetractEvents> events;
  for (const std::string_view name : kMaterials) {
    const auto entry = library.require(name);
    if (!entry) {
      return core::failure(core::ErrorCategory::BadInputFile,
                           fmt::format("the material file lacks \"{}\", which the paper's tables hold", name));
    }
    tables.materials.push_back((*entry)->title);
    events[name] = physics::approach_retract_events((*entry)->contact);
  }

  tables.inputs = input_rows(library);
  for (const PrintedTable1& row : kTable1) {
    for (std::size_t i = 0; i < kMaterials.size(); ++i) {
      TableCell cell;
      cell.material = kMaterials[i];
      cell.quantity = row.quantity;
      cell.unit = row.unit;
      cell.per_si = row.per_si;
      cell.printed = row.printed[i];
      cell.exact = exact_si(events[kMaterials[i]], row.quantity) * row.per_si;
      cell.measured = measured_in(measured, kMaterials[i], row.quantity, row.per_si);
      cell.erratum = row.erratum[i];
      tables.table1.push_back(std::move(cell));
    }
  }

  constexpr double kNewtons = 1e9;  // factor from N to nN
  for (const PrintedTable2& row : kTable2) {
    const scene::MaterialEntry& entry = *library.find(row.material);
    TableCell cell;
    cell.material = row.material;
    cell.quantity = row.quantity;
    cell.unit = "nN";
    cell.per_si = kNewtons;
    cell.printed = row.calculation;
    cell.exact = exact_si(events[row.material], row.quantity) * kNewtons;
    cell.measured = measured_in(measured, row.material, row.quantity, kNewtons);
    const auto& experiment = row.quantity == "F_attr" ? entry.experiment_f_attr : entry.experiment_f_ad;
    if (!experiment) {
      return core::failure(
          core::ErrorCategory::BadInputFile,
          fmt::format("the material file lacks the experiments of \"{}\", which the paper's Table 2 holds",
                      row.material));
    }
    cell.experiment = experiment->si * kNewtons;
    cell.printed_simulation = row.simulation;
    cell.erratum = row.erratum;
    tables.table2.push_back(std::move(cell));
  }
  return tables;
}

}  // namespace afm::curves
