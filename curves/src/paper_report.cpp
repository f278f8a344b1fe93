// SPDX-License-Identifier: Apache-2.0
#include "curves/paper_report.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/written_by.h"
#include "curves/plot_units.h"
#include "curves/svg_plot.h"
#include "paper_contact_mechanics.h"
#include "physics/contact.h"
#include "physics/force_curve.h"

namespace afm::curves {
namespace {

using json = nlohmann::ordered_json;

std::string percent(double value, double reference) { return fmt::format("{:+.3f} %", (value / reference - 1) * 100); }

double number(const std::string& printed) { return std::stod(printed); }

// Text with the number of its erratum: "0.799 [1]".
std::string with_erratum(const std::string& text, std::string_view erratum) {
  return erratum.empty() ? text : fmt::format("{} [{}]", text, erratum_number(erratum));
}

// Text of a cell of the third column, or a dash if no run measured it.
std::string measured_text(const TableCell& cell) { return cell.measured ? fmt::format("{:.4f}", *cell.measured) : "-"; }

std::string inputs_markdown(const PaperTables& tables) {
  std::string text = "| Given | " + fmt::format("{}", fmt::join(tables.materials, " | ")) + " |\n|---|---|---|---|\n";
  for (const InputRow& row : tables.inputs) {
    text += fmt::format("| {} | {} |\n", row.name, fmt::join(row.values, " | "));
  }
  return text;
}

std::string table1_markdown(const PaperTables& tables) {
  std::string text = "|";
  std::string rule = "|---|";
  for (const std::string& title : tables.materials) {
    text += fmt::format(" | {0}: printed | {0}: exact | {0}: measured in the run", title);
    rule += "---:|---:|---:|";
  }
  text += " |\n" + rule + "\n";
  for (std::size_t i = 0; i < tables.table1.size(); i += tables.materials.size()) {
    text += fmt::format("| {} ({})", tables.table1[i].quantity, tables.table1[i].unit);
    for (std::size_t j = i; j < i + tables.materials.size(); ++j) {
      const TableCell& cell = tables.table1[j];
      text +=
          fmt::format(" | {} | {:.4f} | {}", with_erratum(cell.printed, cell.erratum), cell.exact, measured_text(cell));
    }
    text += " |\n";
  }
  return text;
}

std::string table2_markdown(const PaperTables& tables) {
  std::string text =
      "| Material | Force (nN) | Experiment | Calculation: printed | Calculation: exact | Exact against experiment | "
      "Simulation: printed | Measured in the run | Run against exact |\n|---|---|---:|---:|---:|---:|---:|---:|---:|\n";
  for (const TableCell& cell : tables.table2) {
    text += fmt::format("| {} | {} | {:g} | {} | {:.4f} | {}{} | {} | {} | {} |\n", cell.material, cell.quantity,
                        *cell.experiment, with_erratum(cell.printed, cell.erratum), cell.exact,
                        percent(cell.exact, *cell.experiment),
                        cell.quantity == "F_ad" ? fmt::format(" [{}]", erratum_number("circular adhesion")) : "",
                        with_erratum(cell.printed_simulation, "sampled simulation"), measured_text(cell),
                        cell.measured ? percent(*cell.measured, cell.exact) : "-");
  }
  return text;
}

json table_json(const std::vector<TableCell>& cells) {
  json table = json::object();
  for (const TableCell& cell : cells) {
    json entry{{"printed", number(cell.printed) / cell.per_si}, {"exact", cell.exact / cell.per_si}};
    if (!cell.printed_simulation.empty()) {
      entry["printed_simulation"] = number(cell.printed_simulation) / cell.per_si;
    }
    if (cell.experiment) entry["experiment"] = *cell.experiment / cell.per_si;
    entry["measured"] = cell.measured ? json(*cell.measured / cell.per_si) : json();
    entry["erratum"] = cell.erratum.empty() ? json() : json(cell.erratum);
    table[cell.material][cell.quantity + (cell.unit == "nN" ? "_N" : "_m")] = std::move(entry);
  }
  return table;
}

std::string csv_number(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : ""; }

// Range of a plot: everything, or the part nearer than z_max and weaker than force_min.
struct Window {
  double z_max_nm = std::numeric_limits<double>::infinity();
  double force_min_nn = -std::numeric_limits<double>::infinity();

  bool holds(SvgPoint point) const { return point.x <= z_max_nm && point.y >= force_min_nn; }
};

SvgPlot empty_plot(std::string title) {
  SvgPlot plot;
  plot.title = std::move(title);
  plot.x_label = "piezo displacement Z (nm)";
  plot.y_label = "force on the tip F (nN)";
  return plot;
}

// Adds a cycle: approach dashed and retract solid, as everywhere in the program. The turning point belongs to both.
void add_cycle(SvgPlot& plot, const scene::MaterialEntry& material, std::string_view color, const Window& window) {
  const physics::ApproachRetractModel model(material.contact);
  const physics::Length from = 1.4 * model.figures().z_joc;
  const auto curve = physics::record_curve(model, {from, physics::Length(-5e-9), from / 1000.0});
  SvgLine approach{material.title + ", approach", std::string(color), LineStyle::Dashed, {}};
  SvgLine retract{material.title + ", retract", std::string(color), LineStyle::Solid, {}};
  for (const auto& sample : curve.samples) {
    const SvgPoint point{sample.z.si * kNmPerM, sample.force.si * kNnPerN};
    if (!window.holds(point)) continue;
    const bool approaching = sample.branch == physics::Branch::Approach;
    if (!approaching && retract.points.empty()) retract.points.push_back(approach.points.back());
    (approaching ? approach : retract).points.push_back(point);
  }
  plot.lines.push_back(std::move(approach));
  plot.lines.push_back(std::move(retract));
}

}  // namespace

std::string paper_markdown(const PaperTables& tables, const scene::MaterialLibrary& library, std::string_view run,
                           std::string_view survey) {
  std::string text =
      "# The paper's tables and figures, evaluated again\n\n"
      "K. Liu and X. Peng, *Simulating the approach-retract phenomenon of AFM in virtual environment with "
      "haptic interface*. **Printed** is what the paper prints, **exact** its own equations (3.1) to (3.10) "
      "with full precision, **measured in the run** what a run " +
      std::string(run) +
      " gave: where the path crossed a threshold between two of its samples. All forces are magnitudes. Numbers in "
      "brackets lead to the errata below.\n\n## Table 1\n\n" +
      inputs_markdown(tables) + "\n" + table1_markdown(tables) + "\n## Table 2\n\n" + table2_markdown(tables) +
      "\nThe agreement of F_ad with the experiment is **circular**: the surface energies were computed from the "
      "measured pull-off forces. Only F_attr is a prediction.\n\n"
      "## What contact mechanics says of the same samples\n\n" +
      contact_mechanics_markdown(library) +
      "\n## Figures\n\n![The cycle with the letters of Fig. 2](fig2.svg)\n\n"
      "![The three cycles of Fig. 5(e)](fig5e.svg)\n\n## The survey (Table 3)\n\n" +
      std::string(survey) + "## Errata\n\n";
  int count = 0;
  for (const Erratum& erratum : errata()) text += fmt::format("{}. **{}**: {}\n", ++count, erratum.name, erratum.text);
  return text + fmt::format("\nComputed by {}.\n", core::written_by());
}

std::string paper_json(const PaperTables& tables, const scene::MaterialLibrary& library, const json& survey) {
  json list = json::array();
  for (const Erratum& erratum : errata()) list.push_back({{"name", erratum.name}, {"text", erratum.text}});
  json root{{"table1", table_json(tables.table1)},
            {"table2", table_json(tables.table2)},
            {"f_ad_agreement_is_circular", true},
            {"contact_mechanics", contact_mechanics_json(library)},
            {"table3", survey},
            {"errata", list}};
  core::name_software(root);
  return root.dump(2) + "\n";
}

std::string table1_csv(const PaperTables& tables) {
  std::string text = fmt::format("# software: {}\n", core::written_by()) +
                     "# Liu & Peng, Table 1: magnitudes, each in its unit\n"
                     "material,quantity,unit,printed,exact,measured_in_the_run,erratum\n";
  for (const TableCell& cell : tables.table1) {
    text += fmt::format("{},{},{},{},{},{},{}\n", cell.material, cell.quantity, cell.unit, cell.printed, cell.exact,
                        csv_number(cell.measured), cell.erratum);
  }
  return text;
}

std::string table2_csv(const PaperTables& tables) {
  std::string text =
      fmt::format("# software: {}\n", core::written_by()) +
      "# Liu & Peng, Table 2: magnitudes, each in its unit; the agreement of F_ad with the experiment is "
      "circular\n"
      "material,quantity,unit,experiment,printed_calculation,exact,printed_simulation,"
      "measured_in_the_run,erratum\n";
  for (const TableCell& cell : tables.table2) {
    text += fmt::format("{},{},{},{},{},{},{},{},{}\n", cell.material, cell.quantity, cell.unit,
                        csv_number(cell.experiment), cell.printed, cell.exact, cell.printed_simulation,
                        csv_number(cell.measured), cell.erratum);
  }
  return text;
}

std::string figure2_svg(const scene::MaterialEntry& material) {
  using Side = SvgMark::Side;
  const auto events = physics::approach_retract_events(material.contact);
  SvgPlot plot = empty_plot(fmt::format("Fig. 2: one approach-retract cycle ({}, {} tip, {})", material.title,
                                        material.tip, material.medium));
  add_cycle(plot, material, distinct_color(0), {});

  const std::string ink = "#1d2329";
  const double z_jtc = events.z_jtc.si * kNmPerM;
  const double z_joc = events.z_joc.si * kNmPerM;
  const double f_attr = events.f_attr.si * kNnPerN;
  const double f_ad = events.f_ad.si * kNnPerN;
  const std::vector<SvgPoint>& approach = plot.lines.front().points;
  plot.marks = {{approach.front(), "A", ink, Side::Above},
                {{z_joc, 0}, fmt::format("B: Z_joc {:.3f} nm", z_joc), ink, Side::Above},
                {{z_jtc, 0}, fmt::format("C: Z_jtc {:.3f} nm", z_jtc), ink, Side::Above},
                {{z_jtc, -f_attr}, fmt::format("D: F_attr \u2212{:.4f} nN", f_attr), ink, Side::Right},
                {approach.back(), "E", ink, Side::Right},
                {{z_joc, -f_ad}, fmt::format("F: F_ad \u2212{:.4f} nN", f_ad), ink, Side::Right}};
  return svg(plot);
}

std::string figure5e_svg(const scene::MaterialLibrary& library) {
  // all of mica and silicon nitride, and gold's jump to contact
  constexpr Window kNear{25.0, -1.8};
  std::array<SvgPlot, 2> plots{empty_plot("Fig. 5(e): the approach-retract cycles of all samples"),
                               empty_plot("The same, near the surface")};
  const std::array<Window, 2> windows{Window{}, kNear};
  for (std::size_t p = 0; p < plots.size(); ++p) {
    std::size_t index = 0;
    for (const scene::MaterialEntry& material : library.materials) {
      const auto events = physics::approach_retract_events(material.contact);
      const std::string_view color = distinct_color(index++);
      add_cycle(plots[p], material, color, windows[p]);
      const SvgPoint pull_off{events.z_joc.si * kNmPerM, -events.f_ad.si * kNnPerN};
      if (!windows[p].holds(pull_off)) continue;
      plots[p].marks.push_back({pull_off, fmt::format("{} \u2212{:.4f} nN", material.title, -pull_off.y),
                                std::string(color), SvgMark::Side::Right});
    }
  }
  return svg(plots);
}

}  // namespace afm::curves
