// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <optional>
#include <string_view>
#include <variant>

namespace afm::python {

// touchafm.Drive: numbers of a lever that taps, in SI; empty: not given. Immutable.
struct Drive {
  std::optional<double> free_amplitude, resonance, quality_factor, frequency, viscosity, contact_gap;
};

struct DriveMember {
  const char* name;
  std::optional<double> Drive::* value;
  std::string_view option;  // option of the command, without dashes
  const char* meaning;
};
inline constexpr std::array kDriveMembers{
    DriveMember{"free_amplitude", &Drive::free_amplitude, "free-amplitude",
                "Free amplitude at the drive, m, zero-to-peak."},
    DriveMember{"resonance", &Drive::resonance, "resonance", "Resonance, Hz; None: the contact's."},
    DriveMember{"quality_factor", &Drive::quality_factor, "quality-factor", "Quality factor; None: the contact's."},
    DriveMember{"frequency", &Drive::frequency, "drive", "Frequency of the drive, Hz; None: at the resonance."},
    DriveMember{"viscosity", &Drive::viscosity, "viscosity", "Viscosity of the contact, Pa*s; None: none."},
    DriveMember{"contact_gap", &Drive::contact_gap, "contact-gap",
                "Gap of the undeformed contact, m, in place of the work of adhesion; None: not given."}};

// An argument for a drive: all of it, or its frequency in Hz.
using DriveArgument = std::optional<std::variant<Drive, double>>;

// Both together. ValueError for a number that is in both.
Drive joined(const DriveArgument& argument, Drive beside);

}  // namespace afm::python
