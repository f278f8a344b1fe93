// SPDX-License-Identifier: Apache-2.0
#include "python/contact.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/own_folder.h"
#include "curves/curve_output.h"
#include "physics/law_tables.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/errors.h"
#include "python/json.h"
#include "python/numbers.h"
#include "python/result_type.h"

namespace afm::python {

namespace py = pybind11;

std::string assets_dir() {
  // the module lies in PREFIX/lib/python3/dist-packages/touchafm, of a build as of an installation
  return (core::own_folder() / "../../../../share/touchafm").lexically_normal().string();
}

Contact::Contact(curves::ContactOptions options)
    : options_(std::move(options)), setup_(value_of(curves::contact_setup(options_))) {
  physics::validate(setup_.material.contact);
  physics::validate(setup_.law_options);
  physics::validate(setup_.material.lever);
}

curves::ContactSetup Contact::with_law(const std::optional<std::string>& law) const {
  if (!law) return setup_;
  curves::ContactOptions options = options_;
  options.model = *law;
  return value_of(curves::contact_setup(options));
}

namespace {

// Options with the files of the installation, and nothing else.
curves::ContactOptions built_in() {
  curves::ContactOptions options;
  options.assets_dir = assets_dir();
  return options;
}

using Tables = std::shared_ptr<const physics::LawTables>;

Tables tables_of(const curves::ContactSetup& setup) {
  if (setup.model.direction_rule || setup.model.dynamic) {
    refuse(fmt::format("model {} has no force that depends on the height alone; take cycle()", setup.model.text));
  }
  return physics::build_law_tables(setup.law(), setup.material.contact, setup.law_options);
}

// touchafm.Law: the tables of a law, shared and constant.
struct Law {
  Contact contact;
  std::string name;
  Tables tables;
};

Law make_law(const std::string& name, const Contact& contact) {
  curves::ContactOptions options = contact.options();
  options.model = name;
  Contact chosen(std::move(options));
  Tables tables = tables_of(chosen.setup());
  std::string used = chosen.setup().used_model();
  return {std::move(chosen), std::move(used), std::move(tables)};
}

py::object force_on(const Law& law, const GivenArray& z, const std::string& branch) {
  if (branch != "free" && branch != "attached") {
    refuse(fmt::format("unknown branch \"{}\"; choose free or attached", branch));
  }
  const physics::BranchTable& table = branch == "free" ? law.tables->free : law.tables->attached;
  return each(z, [&table](double z_m) { return std::isnan(z_m) ? z_m : table.force(physics::Length(z_m)).si; });
}

Contact make_contact(const std::optional<std::string>& material, const std::optional<std::string>& probe,
                     const std::string& law, bool exact_sphere, const std::vector<std::string>& material_files,
                     const std::vector<std::string>& probe_files, const py::kwargs& numbers) {
  curves::ContactOptions options = built_in();
  options.material = material.value_or("");
  options.probe = probe.value_or("");
  options.model = law;
  options.exact_sphere = exact_sphere;
  options.material_files = material_files;
  options.probe_files = probe_files;
  options.si_values = numbers_of(numbers);
  for (const auto& [option, si] : options.si_values) {
    if (curves::find_contact_parameter(option) == nullptr) unknown_keyword("Contact", keyword_of(option));
  }
  return Contact(std::move(options));
}

// Pickles the arguments, so that a file of another version is checked again.
py::tuple state_of(const Contact& contact) {
  const curves::ContactOptions& options = contact.options();
  return py::make_tuple(options.material, options.probe, options.model, options.exact_sphere, options.material_files,
                        options.probe_files,
                        std::map<std::string, double>(options.si_values.begin(), options.si_values.end()));
}

Contact contact_from(const py::tuple& state) {
  if (state.size() != 7) throw py::value_error("this is no pickled contact of this version of touchafm");
  curves::ContactOptions options = built_in();
  options.material = state[0].cast<std::string>();
  options.probe = state[1].cast<std::string>();
  options.model = state[2].cast<std::string>();
  options.exact_sphere = state[3].cast<bool>();
  options.material_files = state[4].cast<std::vector<std::string>>();
  options.probe_files = state[5].cast<std::vector<std::string>>();
  for (const auto& [option, si] : state[6].cast<std::map<std::string, double>>()) options.si_values[option] = si;
  return Contact(std::move(options));
}

py::dict dict_of_contact(const Contact& contact) {
  const curves::ContactSetup& setup = contact.setup();
  nlohmann::ordered_json json = curves::law_json(setup, setup.used_model(), setup.place());
  json["parameters"] = curves::parameters_json(setup);
  curves::add_sources(json, setup);
  return dict_of(json);
}

void add_figures(py::module_& module) {
  using physics::CycleFigures;
  py::class_<CycleFigures> figures(module, "Figures", plain_type(), py::is_final(),
                                   "Results of one cycle of a law at rest, solved exactly. SI; forces on the tip are "
                                   "positive away from the sample.");
  figures.def_readonly("hysteretic", &CycleFigures::hysteretic,
                       "False: the lever is so stiff that approach and retract are one curve.");
  const auto add = [&figures](const char* name, auto member, const char* doc) {
    figures.def_property_readonly(name, [member](const CycleFigures& self) { return (self.*member).si; }, doc);
  };
  add("z_jtc", &CycleFigures::z_jtc,
      "Height of the lever's base at the jump to contact, m; Hao 1991, (3.6) of Liu & Peng for the paper's law.");
  add("force_before_jtc", &CycleFigures::force_before_jtc, "Force just before the jump to contact, N.");
  add("force_after_jtc", &CycleFigures::force_after_jtc, "Force just after it, N.");
  add("z_joc", &CycleFigures::z_joc, "Height of the base at the jump off contact, m.");
  add("force_before_joc", &CycleFigures::force_before_joc, "Pull-off force, N: negative.");
  add("force_after_joc", &CycleFigures::force_after_joc, "Force just after the jump off contact, N.");
  add("loop_energy", &CycleFigures::loop_energy, "Energy lost in a cycle, J.");
  add("critical_stiffness", &CycleFigures::critical_stiffness,
      "Spring constant at and above which there is no hysteresis, N/m; infinite if there always is.");
}

void add_contact_class(py::module_& module) {
  py::class_<Contact> contact(module, "Contact", plain_type(), py::is_final(),
                              "Tip, lever, sample and medium, with the source of each number. Immutable.");
  contact.def(
      py::init(&make_contact), py::kw_only(), py::arg("material") = py::none(), py::arg("probe") = py::none(),
      py::arg("law") = "auto", py::arg("exact_sphere").noconvert() = false,
      py::arg("material_files") = std::vector<std::string>(), py::arg("probe_files") = std::vector<std::string>(),
      "A contact of a known material, or of numbers in SI; each number replaces the material's or the probe's.\n\n"
      "material, probe: names that materials() and probes() list, with those of material_files and probe_files "
      "(TOML).\n"
      "law: as --model of touchafm curve; auto chooses by Tabor's parameter (Johnson & Greenwood 1997).\n"
      "Numbers: tip_radius m, spring_constant N/m, sample_stiffness N/m, hamaker J, work_of_adhesion J/m2,\n"
      "reduced_modulus Pa, atomic_distance m, retardation m, humidity 0 to 1, resonance Hz, quality_factor,\n"
      "temperature K.\n\n"
      "Raises ValueError for an unknown name, and for a number that is missing, has no effect on the law or is\n"
      "unphysical; FileError for a file that cannot be read.");
  contact.def_static(
      "material",
      [](const std::string& material, const py::kwargs& given) {
        return py::type::of<Contact>()(py::arg("material") = material, **given);
      },
      py::arg("material"), "Contact(material=material, ...).");
  for (const curves::ContactParameter& parameter : curves::contact_parameters()) {
    contact.def_property_readonly(
        keyword_of(parameter.option).c_str(), [&parameter](const Contact& self) { return parameter.get(self.setup()); },
        fmt::format("{}; in SI. None if it is not set.", parameter.help).c_str());
  }
  contact.def_property_readonly(
      "law", [](const Contact& self) { return self.setup().used_model(); }, "Law of force that is used: \"dmt\".");
  contact.def_property_readonly(
      "figures", [](const Contact& self) { return tables_of(self.setup())->figures; }, "Figures of its law.");
  contact.def_property_readonly(
      "tabor",
      [](const Contact& self) {
        const auto place = self.setup().place();
        return place ? std::optional(place->tabor) : std::nullopt;
      },
      "Tabor's parameter (Tabor 1977); None without work of adhesion.");
  contact.def_property_readonly(
      "title", [](const Contact& self) { return self.setup().material.title; }, "Name for people: \"Mica\".");
  contact.def("as_dict", &dict_of_contact, "Law, parameters and sources as in the JSON of touchafm curve.");
  contact.def("__repr__", [](const Contact& self) {
    return fmt::format("<touchafm.Contact {}, law {}>", self.setup().material.name, self.setup().used_model());
  });
  contact.def(py::pickle(&state_of, &contact_from));
}

void add_law_class(py::module_& module) {
  py::class_<Law> law(module, "Law", plain_type(), py::is_final(),
                      "A law of force with its lever: two branches and two jumps. Immutable.");
  law.def("force", &force_on, py::arg("z"), py::kw_only(), py::arg("branch") = "free",
          "Force on the tip, N, for heights z of the lever's base, m: an array of z's shape, or a float; NaN for\n"
          "NaN.\n\n"
          "branch: \"free\" ends at figures.z_jtc, \"attached\" at figures.z_joc; beyond, the end's force.\n"
          "Raises ValueError for another branch. The lock of Python is released meanwhile.");
  law.def_readonly("name", &Law::name, "Name of the law: \"jkr\".");
  law.def_readonly("contact", &Law::contact, "Contact with this law.");
  law.def_property_readonly("figures", [](const Law& self) { return self.tables->figures; }, "Jumps and energies.");
  law.def(py::pickle([](const Law& self) { return py::make_tuple(self.contact); },
                     [](const py::tuple& state) {
                       if (state.size() != 1)
                         throw py::value_error("this is no pickled law of this version of touchafm");
                       const auto contact = state[0].cast<Contact>();
                       return make_law(contact.options().model, contact);
                     }));
  law.def("__repr__", [](const Law& self) { return fmt::format("<touchafm.Law {}>", self.name); });
}

std::vector<std::string> probe_names() {
  std::vector<std::string> names;
  for (const scene::ProbeEntry& probe : value_of(load_probes(built_in())).probes) names.push_back(probe.name);
  return names;
}

}  // namespace

void add_contacts(py::module_& module) {
  add_figures(module);
  add_contact_class(module);
  add_law_class(module);
  module.def(
      "materials", [] { return value_of(load_materials(built_in())).names(); }, "Names of the built-in materials.");
  module.def("probes", &probe_names, "Names of the built-in probes.");
  module.def("law", &make_law, py::arg("name"), py::arg("contact"),
             "The law of that name (as --model of touchafm curve) for a contact. ValueError if there is none.\n"
             "docs/physics.md has its equations with their sources.");
}

}  // namespace afm::python
