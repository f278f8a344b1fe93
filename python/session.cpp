// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "curves/felt_sources.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/contact.h"
#include "python/errors.h"
#include "python/json.h"
#include "python/long_work.h"
#include "python/result_type.h"
#include "servo/session_file.h"

namespace afm::python {

namespace {

namespace py = pybind11;
using scene::TipSample;
using servo::RecordedSession;

template <class Member>
auto samples(Member member) {
  return [member](const py::object& self) { return column(self, self.cast<const RecordedSession&>().samples, member); };
}

py::list events_of(const RecordedSession& session) {
  py::list events;
  for (const scene::TipEvent& event : session.events) {
    py::dict row;
    row["kind"] = physics::name_of(event.kind);
    row["time"] = session.seconds_since_start(event.time_ns);
    row["z"] = event.z_m;
    row["force_before"] = event.force_before_n;
    row["force_after"] = event.force_after_n;
    events.append(std::move(row));
  }
  return events;
}

nlohmann::ordered_json contact_numbers(const RecordedSession& session) {
  return curves::session_numbers(session.material, session.parameters, session.sources, assets_dir());
}

// Array of one number of each event.
template <class Value>
auto of_events(Value value) {
  return [value](const RecordedSession& self) {
    return computed(self.events, [&self, &value](const scene::TipEvent& event) { return value(self, event); });
  };
}

py::object event_kinds(const RecordedSession& session) {
  py::list kinds;
  for (const scene::TipEvent& event : session.events) kinds.append(physics::name_of(event.kind));
  py::object array = py::module_::import("numpy").attr("array")(kinds, "U");
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

std::shared_ptr<RecordedSession> load(const std::filesystem::path& path) {
  return std::make_shared<RecordedSession>(
      value_of(long_work([path = path.string()](const std::stop_token&) { return servo::load_session(path); })));
}

using SessionType = py::class_<RecordedSession, std::shared_ptr<RecordedSession>>;

void add_events(SessionType& type) {
  type.def_property_readonly("events", &events_of,
                             "Events in their order: dicts of kind, time s, z m, force_before N and force_after N.")
      .def_property_readonly("event_kind", &event_kinds, "Kind of each event, \"jump-to-contact\".")
      .def_property_readonly("event_time", of_events([](const RecordedSession& self, const scene::TipEvent& event) {
                               return self.seconds_since_start(event.time_ns);
                             }),
                             "Time of each event since the start, s.")
      .def_property_readonly("event_z",
                             of_events([](const RecordedSession&, const scene::TipEvent& event) { return event.z_m; }),
                             "Height of the lever's base at each event, m.")
      .def_property_readonly("event_force_before", of_events([](const RecordedSession&, const scene::TipEvent& event) {
                               return event.force_before_n;
                             }),
                             "Force just before each event, N.")
      .def_property_readonly("event_force_after", of_events([](const RecordedSession&, const scene::TipEvent& event) {
                               return event.force_after_n;
                             }),
                             "Force just after each event, N.");
}

}  // namespace

void add_sessions(py::module_& module) {
  SessionType type(module, "Session", plain_type(), py::is_final(),
                   "What a hand felt: every tick of the servo and every event. SI. Immutable.");
  add_events(type);
  type.def_readonly("material", &RecordedSession::material, "Name of the material.")
      .def_property_readonly(
          "parameters", [](const RecordedSession& self) { return dict_of(contact_numbers(self)["parameters"]); },
          "Every number of the contact that was felt, by the keys of touchafm replay --json. SI.")
      .def_property_readonly(
          "sources", [](const RecordedSession& self) { return dict_of(contact_numbers(self)["sources"]); },
          "Sources of the law and of each number: dicts of value, source and estimated. In a file of 0.2.0 or older, "
          "those of the built-in material, where the numbers are the same.")
      .def_readonly("rate", &RecordedSession::rate_hz, "Rate of the servo, Hz.")
      .def_readonly("complete", &RecordedSession::complete, "False: the file was cut, and this is its beginning.")
      .def_property_readonly(
          "time",
          [](const RecordedSession& self) {
            return computed(self.samples,
                            [&self](const TipSample& sample) { return self.seconds_since_start(sample.time_ns); });
          },
          "Time of each sample since the start, s.")
      .def_property_readonly("z", samples([](const TipSample& s) -> const double& { return s.tip.z_m; }),
                             "Height of the lever's base above the surface, m.")
      .def_property_readonly("force", samples([](const TipSample& s) -> const double& { return s.tip.force_n; }),
                             "Force on the tip, N, positive away from the sample.")
      .def_property_readonly("tip_height", samples([](const TipSample& s) -> const double& { return s.tip.height_m; }),
                             "Height of the apex, m.")
      .def_property_readonly("deflection",
                             samples([](const TipSample& s) -> const double& { return s.tip.deflection_m; }),
                             "Bend of the lever, m, positive towards the sample.")
      .def_property_readonly("hand_height",
                             samples([](const TipSample& s) -> const double& { return s.hand_height_m; }),
                             "Height of the hand in the device's frame, m.")
      .def_property_readonly("hand_force", samples([](const TipSample& s) -> const double& { return s.hand_force_n; }),
                             "Force on the hand, N, after all limits.")
      .def_property_readonly(
          "in_contact",
          [](const RecordedSession& self) {
            return computed(self.samples,
                            [](const TipSample& sample) { return sample.phase == physics::Phase::Attached; });
          },
          "True while the tip touches.")
      .def("__len__", [](const RecordedSession& self) { return self.samples.size(); })
      .def("__repr__", [](const RecordedSession& self) {
        return fmt::format("<touchafm.Session on {}, {} samples>", self.material, self.samples.size());
      });
  module.def("session", &load, py::arg("path"),
             "A session that touchafm demo or view has recorded (.afms). FileError if it is none.");
}

}  // namespace afm::python
