// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/printable.h"
#include "curves/curve_report.h"
#include "curves/fitting/curve_fit.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/curve.h"
#include "python/errors.h"
#include "python/json.h"
#include "python/long_work.h"
#include "python/named_row.h"
#include "python/numbers.h"
#include "python/result_type.h"

namespace afm::python {

namespace {

namespace py = pybind11;
using curves::AnalysedCurve;

// touchafm.Fit.
struct Fit {
  curves::FitOptions options;
  fits::ElasticFit found;
};

std::optional<physics::ContactMethod> method_of(const std::optional<std::string>& name) {
  if (!name) return std::nullopt;
  std::string names;
  for (const auto& each : physics::kContactMethods) {
    if (each.name == *name) return each.method;
    names += (names.empty() ? "" : ", ") + std::string(each.name);
  }
  refuse(fmt::format("unknown method \"{}\"; choose {}", *name, names));
}

AnalysedCurve analyse(const Curve& curve, const std::optional<std::string>& contact_point) {
  auto analysis = long_work([curve, method = method_of(contact_point)](const std::stop_token&) {
    return curves::analysed(curve.name, curve.recorded, method);
  });
  return value_of(std::move(analysis), FaultOf::Data);
}

void set_numbers(const py::kwargs& given, curves::FitOptions& options) {
  for (const auto& [option, si] : numbers_of(given)) {
    // the tip is named as in a contact
    const std::string_view name = option == "tip-radius" ? std::string_view("radius") : std::string_view(option);
    const curves::FitNumber* found = nullptr;
    for (const curves::FitNumber& number : curves::fit_numbers()) {
      if (number.name == name) found = &number;
    }
    if (found == nullptr || option == "radius") unknown_keyword("fit", keyword_of(option));
    const std::string refusal = curves::refusal(si, physics::format_si(si, found->domain.units), found->domain);
    if (!refusal.empty()) refuse(fmt::format("--{}: {}", name, refusal));
    found->set(options, si);
  }
}

Fit fit(const py::object& given, const std::string& model, const std::optional<std::string>& base,
        const std::optional<std::string>& against, bool tilt, bool white_noise, bool bootstrap,
        const std::map<std::string, double>& uncertainties, const std::optional<std::string>& contact_point,
        const py::kwargs& numbers) {
  curves::FitOptions options;
  options.shape = row_named(fits::kShapes, model, "model").shape;
  if (base) options.base = row_named(fits::kBases, *base, "base").base;
  if (against) options.against = row_named(fits::kAgainst, *against, "variable").against;
  options.tilt = tilt;
  options.white = white_noise;
  options.bootstrap = bootstrap;
  for (const auto& [key, share] : uncertainties) {
    std::string name(key);
    std::replace(name.begin(), name.end(), '_', '-');
    options.uncertainty_texts.push_back(
        fmt::format("{}={:.15g}%", name == "tip-radius" ? "radius" : name, 100.0 * share));
  }
  set_numbers(numbers, options);
  if (!py::isinstance<AnalysedCurve>(given) && !py::isinstance<Curve>(given)) {
    const std::string type = py::str(py::type::of(given).attr("__name__"));
    throw py::type_error(fmt::format("curve: give a Curve or its Analysis, not {}", type));
  }
  if (contact_point && !py::isinstance<Curve>(given)) refuse("contact_point: an Analysis has its own; give the Curve");
  const AnalysedCurve curve = py::isinstance<AnalysedCurve>(given) && !contact_point
                                  ? given.cast<AnalysedCurve>()
                                  : analyse(given.cast<Curve>(), contact_point);
  auto fitted = long_work([options, curve](const std::stop_token&) mutable -> core::Result<Fit> {
    if (const auto ready = curves::prepare(options); !ready) return tl::unexpected(ready.error());
    auto found = curves::fit_of(curve, options);
    if (!found) return tl::unexpected(found.error());
    return Fit{std::move(options), std::move(*found)};
  });
  return value_of(std::move(fitted), FaultOf::Data);
}

template <class Q>
std::optional<double> si_of(const std::optional<Q>& value) {
  return value ? std::optional(value->si) : std::nullopt;
}

void add_analysis(py::module_& module) {
  py::class_<AnalysedCurve>(module, "Analysis", plain_type(), py::is_final(),
                            "Figures of a curve (docs/curves.md defines each). SI; forces above the baseline; None for "
                            "what was not found. Immutable.")
      .def_readonly("name", &AnalysedCurve::name, "Name of the curve.")
      .def_property_readonly(
          "contact_point", [](const AnalysedCurve& self) { return si_of(self.features.contact_point); },
          "Height of the base at the contact point, m.")
      .def_property_readonly(
          "contact_slope", [](const AnalysedCurve& self) { return si_of(self.features.contact_slope); },
          "Slope of the contact, N/m.")
      .def_property_readonly(
          "adhesion",
          [](const AnalysedCurve& self) {
            return self.features.adhesion ? std::optional(self.features.adhesion->force.si) : std::nullopt;
          },
          "Strongest pull of the retract, N: negative.")
      .def_property_readonly(
          "loop_energy", [](const AnalysedCurve& self) { return self.features.loop_energy.si; },
          "Energy between the branches, J.")
      .def_property_readonly(
          "baseline", [](const AnalysedCurve& self) { return self.features.baseline.level.si; },
          "Force of the free lever at the far end, N.")
      .def_property_readonly(
          "noise", [](const AnalysedCurve& self) { return self.features.baseline.noise.si; },
          "Standard deviation around the baseline, N.")
      .def(
          "as_dict", [](const AnalysedCurve& self) { return dict_of(curves::features_json(self, nullptr)); },
          "The JSON of touchafm analyse --json.")
      .def("__repr__", [](const AnalysedCurve& self) {
        return fmt::format("<touchafm.Analysis of {}>", core::printable_line(self.name));
      });
  module.def("analyse", &analyse, py::arg("curve"), py::kw_only(), py::arg("contact_point") = py::none(),
             "Figures of a curve, as touchafm analyse finds them. contact_point: name of a method instead of the\n"
             "analysis's choice. DataError if the curve cannot be analysed, ValueError for an unknown method.\n"
             "docs/curves.md defines the figures.");
}

py::tuple interval(const fits::Interval& of) { return py::make_tuple(of.low, of.high); }

void add_intervals(py::class_<Fit>& found) {
  found
      .def_property_readonly(
          "E_interval", [](const Fit& self) { return interval(self.found.modulus_interval_pa); },
          "95 % interval of E by the noise alone, Pa: low, high.")
      .def_property_readonly(
          "W",
          [](const Fit& self) {
            return self.found.adhesion ? std::optional(self.found.adhesion->work_j_per_m2) : std::nullopt;
          },
          "Work of adhesion, J/m2; None without adhesion.")
      .def_property_readonly(
          "W_interval",
          [](const Fit& self) -> py::object {
            if (!self.found.adhesion) return py::none();
            return interval(self.found.adhesion->work_interval);
          },
          "95 % interval of W, J/m2.")
      .def_property_readonly(
          "E_bootstrap_interval",
          [](const Fit& self) -> py::object {
            if (!self.found.bootstrap) return py::none();
            return interval(self.found.bootstrap->modulus_pa);
          },
          "95 % interval of E by a bootstrap, Pa: low, high; None without bootstrap=True, or if too few fits had an "
          "end.")
      .def_property_readonly(
          "W_bootstrap_interval",
          [](const Fit& self) -> py::object {
            if (!self.found.bootstrap || !self.found.adhesion) return py::none();
            return interval(self.found.bootstrap->work_j_per_m2);
          },
          "The same of W, J/m2.");
}

void add_fit(py::module_& module) {
  py::class_<Fit> found(module, "Fit", plain_type(), py::is_final(),
                        "A fitted contact (docs/fits.md defines each figure). SI. Immutable.");
  const auto add = [&found](const char* name, double fits::ElasticFit::* member, const char* doc) {
    found.def_property_readonly(name, [member](const Fit& self) { return self.found.*member; }, doc);
  };
  add("E", &fits::ElasticFit::modulus_pa, "Young's modulus, Pa, for the given Poisson's ratio.");
  add("reduced_modulus", &fits::ElasticFit::reduced_modulus_pa, "E/(1 - nu^2), Pa.");
  add("contact_point", &fits::ElasticFit::contact_z_m, "Height of the base, or of the tip, at the contact point, m.");
  add("level", &fits::ElasticFit::level_n, "Baseline at the first point, N.");
  add("tilt", &fits::ElasticFit::tilt_n_per_m, "Slope of the baseline, N/m.");
  add("depth", &fits::ElasticFit::depth_m, "Largest depth, m.");
  add("noise", &fits::ElasticFit::noise_n, "RMS of the noise, N.");
  add("rms", &fits::ElasticFit::rms_n, "RMS of all residuals, N.");
  add_intervals(found);
  found
      .def_property_readonly(
          "model", [](const Fit& self) { return fits::row_of(self.found.shape).name; },
          "Shape or law; of \"auto\" the chosen one.")
      .def_property_readonly(
          "flag", [](const Fit& self) { return fits::name_of(self.found.trust); },
          "Whether E can be trusted, in a word.")
      .def_property_readonly(
          "doubts",
          [](const Fit& self) {
            std::vector<std::string> texts;
            texts.reserve(self.found.doubts.size());
            for (const fits::Found& each : self.found.doubts) texts.push_back(curves::doubt_text(each));
            return texts;
          },
          "Reasons for the flag, each with its figure and limit.")
      .def_property_readonly(
          "force",
          [](const py::object& self) { return column(self, self.cast<const Fit&>().found.model_n, std::identity()); },
          "Force of the model at each fitted point, N, baseline included.")
      .def(
          "as_dict", [](const Fit& self) { return dict_of(curves::fit_json(self.found, self.options)); },
          "\"fit\" in the JSON of touchafm analyse --fit --json.")
      .def("__repr__", [](const Fit& self) {
        return fmt::format("<touchafm.Fit {}, E = {:.4g} Pa, {}>", fits::row_of(self.found.shape).name,
                           self.found.modulus_pa, fits::name_of(self.found.trust));
      });
}

void add_fit_function(py::module_& module) {
  module.def("fit", &fit, py::arg("curve"), py::kw_only(), py::arg("model"), py::arg("base") = py::none(),
             py::arg("against") = py::none(), py::arg("tilt").noconvert() = false,
             py::arg("white_noise").noconvert() = false, py::arg("bootstrap").noconvert() = false,
             py::arg("uncertainties") = std::map<std::string, double>(), py::arg("contact_point") = py::none(),
             "Elastic modulus of a curve with its interval, as touchafm analyse --fit finds it.\n\n"
             "curve: a Curve or its Analysis. model: a shape or a law of adhesion of --fit.\n"
             "Numbers: tip_radius m, half_angle rad, layer m, poisson, atomic_distance m, most_force N, most_depth m.\n"
             "bootstrap: also intervals of E and W by 200 more fits to residuals that are drawn in blocks, against z.\n"
             "uncertainties: relative standard deviations of what is given, {\"spring_constant\": 0.1}.\n"
             "Raises ValueError as the command refuses its options, DataError for a curve that nothing fits.\n"
             "docs/fits.md has the equations with their sources; as_dict()[\"source\"] is that of the shape.");
}

}  // namespace

void add_fits(py::module_& module) {
  add_analysis(module);
  add_fit(module);
  add_fit_function(module);
}

}  // namespace afm::python
