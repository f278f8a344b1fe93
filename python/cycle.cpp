// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "curves/curve_output.h"
#include "curves/curve_run.h"
#include "curves/paper_report.h"
#include "curves/sweep.h"
#include "physics/force_curve.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/contact.h"
#include "python/errors.h"
#include "python/json.h"
#include "python/long_work.h"
#include "python/numbers.h"
#include "python/result_type.h"
#include "scene/samples/material_library.h"

namespace afm::python {

namespace {

namespace py = pybind11;
using curves::CurveRun;
using physics::CurveSample;

// touchafm.Sweep: the arguments and results of a sweep.
struct Sweep {
  curves::ContactSetup setup;
  std::vector<curves::SweepAxis> axes;
  std::vector<curves::SweepRow> rows;
};

CurveRun make_cycle(const Contact& contact, const std::optional<std::string>& law, std::optional<double> z_from,
                    std::optional<double> z_to, std::optional<double> step, std::optional<double> speed,
                    const std::optional<Whole>& seed) {
  constexpr std::uint64_t kMostSeed = std::numeric_limits<std::uint64_t>::max();
  const curves::PathOptions path{
      .from = typed(z_from, "m"),
      .to = typed(z_to, "m"),
      .step = typed(step, "m"),
      .speed = typed(speed, "m/s"),
      .seed = seed ? fmt::format("{}", whole_within("seed", *seed, 0, kMostSeed)) : std::string()};
  return value_of(long_work(
      [setup = contact.with_law(law), path](const std::stop_token&) { return curves::run_curve(setup, path); }));
}

void add_event(py::module_& module) {
  using physics::ModelEvent;
  py::class_<ModelEvent>(module, "Event", plain_type(), py::is_final(),
                         "A jump of the tip. SI; forces positive away from the sample.")
      .def_property_readonly(
          "kind", [](const ModelEvent& self) { return physics::name_of(self.kind); },
          "\"jump-to-contact\" or \"jump-off-contact\".")
      .def_property_readonly(
          "z", [](const ModelEvent& self) { return self.z.si; }, "Height of the lever's base, m.")
      .def_property_readonly(
          "force_before", [](const ModelEvent& self) { return self.force_before.si; }, "Force just before it, N.")
      .def_property_readonly(
          "force_after", [](const ModelEvent& self) { return self.force_after.si; }, "Force just after it, N.")
      .def_property_readonly(
          "force", [](const ModelEvent& self) { return self.force_before.si; },
          "The same as force_before: of the jump off contact, the pull-off force, N.")
      .def("__repr__", [](const ModelEvent& self) {
        return fmt::format("<touchafm.Event {} at {} m, {} N>", physics::name_of(self.kind), self.z.si,
                           self.force_before.si);
      });
}

template <class Member>
auto column_of(Member member) {
  return [member](const py::object& self) {
    return column(self, self.cast<const CurveRun&>().curve.samples,
                  [member](const CurveSample& sample) -> const double& { return (sample.*member).si; });
  };
}

std::optional<physics::ModelEvent> event_of(const CurveRun& run, physics::EventKind kind) {
  const physics::ModelEvent* event = curves::find_event(run.curve, kind);
  return event != nullptr ? std::optional(*event) : std::nullopt;
}

void add_cycle(py::module_& module) {
  py::class_<CurveRun> cycle(module, "Cycle", plain_type(), py::is_final(),
                             "One approach-retract cycle: approach, then retract; a jump is two points. Immutable.");
  cycle.def_property_readonly("z", column_of(&CurveSample::z), "Height of the lever's base, m.")
      .def_property_readonly("force", column_of(&CurveSample::force), "Force on the tip, N, positive away from it.")
      .def_property_readonly("tip_height", column_of(&CurveSample::tip_height), "Height of the apex, m.")
      .def_property_readonly("deflection", column_of(&CurveSample::cantilever_deflection), "Bend of the lever, m.")
      .def_property_readonly("sample_deformation", column_of(&CurveSample::sample_deformation),
                             "Deformation of the sample, m.")
      .def_property_readonly(
          "approach",
          [](const CurveRun& self) {
            return computed(self.curve.samples,
                            [](const CurveSample& sample) { return sample.branch == physics::Branch::Approach; });
          },
          "True on the approach.")
      .def_property_readonly(
          "in_contact",
          [](const CurveRun& self) {
            return computed(self.curve.samples,
                            [](const CurveSample& sample) { return sample.phase == physics::Phase::Attached; });
          },
          "True while the tip touches.")
      .def_property_readonly(
          "events", [](const CurveRun& self) { return self.curve.events; }, "Jumps in their order.")
      .def_property_readonly(
          "snap_in", [](const CurveRun& self) { return event_of(self, physics::EventKind::JumpToContact); },
          "Jump to contact, or None.")
      .def_property_readonly(
          "pull_off", [](const CurveRun& self) { return event_of(self, physics::EventKind::JumpOffContact); },
          "Jump off contact, or None.")
      .def_property_readonly(
          "loop_energy",
          [](const CurveRun& self) {
            const auto energy = curves::loop_energy(self);
            return energy ? std::optional(energy->si) : std::nullopt;
          },
          "Energy lost in the cycle, J; None if its loop is open.")
      .def_readonly("figures", &CurveRun::figures, "Figures of the law at rest.")
      .def_readonly("law", &CurveRun::model, "Law that was used: \"dmt\".")
      .def(
          "as_dict", [](const CurveRun& self) { return dict_of(curves::curve_json(self)); },
          "The JSON of touchafm curve --json.")
      .def("__len__", [](const CurveRun& self) { return self.curve.samples.size(); })
      .def("__repr__", [](const CurveRun& self) {
        return fmt::format("<touchafm.Cycle {} on {}, {} points>", self.model, self.setup.material.name,
                           self.curve.samples.size());
      });
  module.def("cycle", &make_cycle, py::arg("contact"), py::arg("law") = py::none(), py::kw_only(),
             py::arg("z_from") = py::none(), py::arg("z_to") = py::none(), py::arg("step") = py::none(),
             py::arg("speed") = py::none(), py::arg("seed") = py::none(),
             "One cycle of a contact, as touchafm curve computes it.\n\n"
             "law: instead of the contact's; dynamic-... includes the lever's mass and thermal noise.\n"
             "z_from, z_to, step: path of the lever's base, m; speed in m/s and seed for dynamic laws only.\n"
             "Raises ValueError for what the law does not know. docs/physics.md has the equations with their sources.");
}

Sweep make_sweep(const Contact& contact, const std::optional<std::string>& law, const py::kwargs& given) {
  Sweep sweep{contact.with_law(law), {}, {}};
  for (const auto& [key, value] : given) {
    const auto keyword = key.cast<std::string>();
    std::string option(keyword);
    std::replace(option.begin(), option.end(), '_', '-');
    const curves::ContactParameter* parameter = curves::find_contact_parameter(option);
    if (parameter == nullptr) unknown_keyword("sweep", keyword);
    if (!curves::changes_force(*parameter, sweep.setup.model)) {
      refuse(fmt::format("--{} has no effect on model {}; remove it", option, sweep.setup.model.text));
    }
    const auto values = GivenArray::of(value);
    if (!values) not_numbers(keyword, "numbers", value);
    curves::SweepAxis axis{.parameter = parameter, .count = static_cast<std::uint64_t>(values->size())};
    axis.values.assign(values->data(), values->data() + values->size());
    if (axis.values.empty()) refuse(fmt::format("{}: the sweep has no value", keyword));
    sweep.axes.push_back(std::move(axis));
  }
  if (sweep.axes.empty() || sweep.axes.size() > 2) refuse("a sweep varies one parameter or two");
  sweep.rows = value_of(long_work([setup = sweep.setup, axes = sweep.axes](const std::stop_token& stop) {
    return curves::run_sweep(setup, axes, {}, stop);
  }));
  return sweep;
}

// Array in the shape of the sweep.
template <class Value>
py::object shaped(const Sweep& sweep, const Value& value) {
  py::object flat = computed(sweep.rows, value);
  if (sweep.axes.size() == 1) return flat;
  return flat.attr("reshape")(sweep.axes[0].count, sweep.axes[1].count);
}

void add_sweep(py::module_& module) {
  using curves::SweepRow;
  struct Column {
    const char* name;
    double SweepRow::* value;
    const char* doc;
  };
  static constexpr std::array kColumns{
      Column{"snap_in_z", &SweepRow::snap_in_z_m, "Height of the base at the jump to contact, m; NaN without one."},
      Column{"z_jtc", &SweepRow::snap_in_z_m, "The same as snap_in_z, m, by its name in figures."},
      Column{"snap_in_force_before", &SweepRow::snap_in_force_before_n, "Force before it, N."},
      Column{"snap_in_force_after", &SweepRow::snap_in_force_after_n, "Force after it, N."},
      Column{"pull_off_z", &SweepRow::pull_off_z_m, "Height of the base at the jump off contact, m; NaN without one."},
      Column{"z_joc", &SweepRow::pull_off_z_m, "The same as pull_off_z, m, by its name in figures."},
      Column{"pull_off_force", &SweepRow::pull_off_force_n, "Pull-off force, N: negative."},
      Column{"loop_energy", &SweepRow::loop_energy_j, "Energy lost in a cycle, J."},
      Column{"critical_stiffness", &SweepRow::critical_stiffness_n_per_m, "Stiffness without hysteresis, N/m."},
      Column{"tabor", &SweepRow::tabor, "Tabor's parameter."},
      Column{"maugis", &SweepRow::maugis, "Maugis' parameter."}};
  py::class_<Sweep> sweep(module, "Sweep", plain_type(), py::is_final(),
                          "Events of a cycle for each value of one parameter, or for a grid of two. Immutable.");
  for (const Column& row : kColumns) {
    sweep.def_property_readonly(
        row.name,
        [member = row.value](const Sweep& self) {
          return shaped(self, [member](const SweepRow& each) { return each.*member; });
        },
        row.doc);
  }
  sweep
      .def_property_readonly(
          "laws",
          [](const Sweep& self) {
            std::vector<std::string> names;
            names.reserve(self.rows.size());
            for (const SweepRow& row : self.rows) names.push_back(row.model);
            return names;
          },
          "Law of each point, the last parameter running fastest.")
      .def_property_readonly(
          "refusals",
          [](const Sweep& self) {
            std::vector<std::string> reasons;
            reasons.reserve(self.rows.size());
            for (const SweepRow& row : self.rows) reasons.push_back(row.refusal);
            return reasons;
          },
          "Why a point has no curve; empty where it has one.")
      .def(
          "as_dict", [](const Sweep& self) { return dict_of(curves::sweep_json(self.setup, self.axes, self.rows)); },
          "The JSON of touchafm curve --sweep.")
      .def("__len__", [](const Sweep& self) { return self.rows.size(); })
      .def("__repr__",
           [](const Sweep& self) { return fmt::format("<touchafm.Sweep of {} points>", self.rows.size()); });
  module.def(
      "sweep", &make_sweep, py::arg("contact"), py::arg("law") = py::none(),
      "The events for arrays of one parameter of the contact or of two: tip_radius=numpy.geomspace(...).\n\n"
      "On all cores, with Python's lock released. Raises ValueError for a parameter without effect, more than a\n"
      "million points, and if no point has a curve. docs/physics.md has the equations with their sources.");
}

// Tables 1 and 2 of Liu & Peng beside the values of the paper's equations, as touchafm paper writes them.
py::dict paper_tables() {
  const auto library = value_of(scene::load_materials(assets_dir() + "/materials.toml"));
  const auto samples = value_of(library.only(scene::kPaperMaterials));
  const auto tables = value_of(curves::paper_tables(samples, curves::measured_events(samples)));
  const py::dict all = py::module_::import("json").attr("loads")(curves::paper_json(tables, samples, {}));
  py::dict result;
  for (const char* table : {"table1", "table2"}) result[table] = all[table];
  return result;
}

}  // namespace

void add_cycles(py::module_& module) {
  add_event(module);
  add_cycle(module);
  add_sweep(module);
  module.def("paper_tables", &paper_tables,
             "Tables 1 and 2 of Liu & Peng, their numbers beside those of their equations; magnitudes in SI.");
}

}  // namespace afm::python
