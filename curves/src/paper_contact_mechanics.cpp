// SPDX-License-Identifier: Apache-2.0
#include "paper_contact_mechanics.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "physics/adhesion_map.h"
#include "physics/law_tables.h"

namespace afm::curves {
namespace {

using json = nlohmann::ordered_json;

// Zero crossing of the attached branch: the zero of Z on the contact line.
double zero_of_contact_m(const physics::LawTables& tables) {
  double pressed = -1e-7, pulled = tables.figures.z_joc.si;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (pressed + pulled);
    (tables.attached.force(physics::Length(middle)).si > 0.0 ? pressed : pulled) = middle;
  }
  return pulled;
}

// Results of the two laws for one material.
struct Comparison {
  std::string title;
  physics::LawChoice choice;
  physics::CycleFigures paper;
  physics::CycleFigures chosen;
  double contact_zero_m;  // contact point of the selected law; the paper's is at 0
};

Comparison compare(const scene::MaterialEntry& material) {
  const auto choice = physics::choose_law(material.contact);
  const auto tables = physics::build_law_tables(choice.law, material.contact);
  return {material.title, choice, physics::build_law_tables(physics::Law::Paper, material.contact)->figures,
          tables->figures, zero_of_contact_m(*tables)};
}

struct Row {
  const char* name;
  const char* key;
  double per_si;
  double (*value)(const physics::CycleFigures& figures, double contact_zero_m);
};

constexpr std::array<Row, 8> kContactRows{
    {{"snap-in at Z (nm)", "snap_in_z_m", 1e9, [](const physics::CycleFigures& f, double) { return f.z_jtc.si; }},
     {"lever's force before it (nN)", "snap_in_force_before_N", 1e9,
      [](const physics::CycleFigures& f, double) { return f.force_before_jtc.si; }},
     {"lever's force after it (nN)", "snap_in_force_after_N", 1e9,
      [](const physics::CycleFigures& f, double) { return f.force_after_jtc.si; }},
     {"pull-off force (nN)", "pull_off_force_N", 1e9,
      [](const physics::CycleFigures& f, double) { return f.force_before_joc.si; }},
     {"pull-off at Z (nm)", "pull_off_z_m", 1e9, [](const physics::CycleFigures& f, double) { return f.z_joc.si; }},
     {"the same from the contact line's zero (nm)", "pull_off_from_contact_zero_m", 1e9,
      [](const physics::CycleFigures& f, double zero) { return f.z_joc.si - zero; }},
     {"loop energy (aJ)", "loop_energy_J", 1e18,
      [](const physics::CycleFigures& f, double) { return f.loop_energy.si; }},
     {"hysteresis vanishes at k_c (N/m)", "critical_stiffness_N_per_m", 1.0,
      [](const physics::CycleFigures& f, double) { return f.critical_stiffness.si; }}}};

std::string cell(double value) { return std::isinf(value) ? "never" : fmt::format("{:.5g}", value + 0.0); }

}  // namespace

std::string contact_mechanics_markdown(const scene::MaterialLibrary& library) {
  std::string text = "| |";
  std::string rule = "|---|";
  std::vector<Comparison> columns;
  for (const scene::MaterialEntry& material : library.materials) {
    columns.push_back(compare(material));
    text += fmt::format(" {0}: paper | {0}: {1} |", material.title, physics::name_of(columns.back().choice.law));
    rule += "---:|---:|";
  }
  text += "\n" + rule + "\n";
  for (const Row& row : kContactRows) {
    text += fmt::format("| {} |", row.name);
    for (const Comparison& c : columns) {
      text += fmt::format(" {} | {} |", cell(row.value(c.paper, 0.0) * row.per_si),
                          cell(row.value(c.chosen, c.contact_zero_m) * row.per_si));
    }
    text += "\n";
  }
  text += "\n";
  for (const Comparison& c : columns) text += fmt::format("- {}: {}.\n", c.title, c.choice.reason);
  return text +
         "\nThe elastic moduli are estimated; a0, where contact begins, is such that both laws have the same pull-off "
         "force. The paper's F_attr is too large because it lets the tip land on the surface instead of at a0.\n";
}

nlohmann::ordered_json contact_mechanics_json(const scene::MaterialLibrary& library) {
  json result = json::object();
  for (const scene::MaterialEntry& material : library.materials) {
    const Comparison c = compare(material);
    json& entry = result[material.name];
    entry = {{"law", physics::name_of(c.choice.law)},
             {"regime", physics::name_of(c.choice.regime)},
             {"tabor_parameter", c.choice.tabor}};
    for (const Row& row : kContactRows) {
      const double paper = row.value(c.paper, 0.0), chosen = row.value(c.chosen, c.contact_zero_m);
      entry["paper"][row.key] = std::isfinite(paper) ? json(paper + 0.0) : json();
      entry["chosen"][row.key] = std::isfinite(chosen) ? json(chosen + 0.0) : json();
    }
  }
  return result;
}

}  // namespace afm::curves
