// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <compare>

namespace afm::physics {

// A number with the dimension kg^Kg m^M s^S, in SI. Sums, comparisons and assignments across dimensions do not compile;
// products and quotients add the exponents, and become a plain double if these cancel.
//
// N/m and J/m^2 are one dimension, so Stiffness and SurfaceEnergy are one type. The compiler cannot distinguish them,
// but named fields do.
template <int Kg, int M, int S>
struct Quantity {
  double si = 0.0;

  constexpr Quantity() = default;
  constexpr explicit Quantity(double value_si) : si(value_si) {}

  constexpr auto operator<=>(const Quantity&) const = default;
  constexpr Quantity operator-() const { return Quantity(-si); }
  constexpr Quantity operator+(Quantity other) const { return Quantity(si + other.si); }
  constexpr Quantity operator-(Quantity other) const { return Quantity(si - other.si); }
  constexpr Quantity operator*(double factor) const { return Quantity(si * factor); }
  constexpr Quantity operator/(double divisor) const { return Quantity(si / divisor); }
};

template <int Kg, int M, int S>
constexpr Quantity<Kg, M, S> operator*(double factor, Quantity<Kg, M, S> q) {
  return q * factor;
}

template <int Kg, int M, int S>
constexpr auto from_si(double value) {
  if constexpr (Kg == 0 && M == 0 && S == 0) {
    return value;
  } else {
    return Quantity<Kg, M, S>(value);
  }
}

template <int Kg1, int M1, int S1, int Kg2, int M2, int S2>
constexpr auto operator*(Quantity<Kg1, M1, S1> a, Quantity<Kg2, M2, S2> b) {
  return from_si<Kg1 + Kg2, M1 + M2, S1 + S2>(a.si * b.si);
}

template <int Kg1, int M1, int S1, int Kg2, int M2, int S2>
constexpr auto operator/(Quantity<Kg1, M1, S1> a, Quantity<Kg2, M2, S2> b) {
  return from_si<Kg1 - Kg2, M1 - M2, S1 - S2>(a.si / b.si);
}

template <int Kg, int M, int S>
auto sqrt(Quantity<Kg, M, S> q) {
  static_assert(Kg % 2 == 0 && M % 2 == 0 && S % 2 == 0, "sqrt needs even exponents");
  return from_si<Kg / 2, M / 2, S / 2>(std::sqrt(q.si));
}

template <int Kg, int M, int S>
auto cbrt(Quantity<Kg, M, S> q) {
  static_assert(Kg % 3 == 0 && M % 3 == 0 && S % 3 == 0, "cbrt needs exponents divisible by three");
  return from_si<Kg / 3, M / 3, S / 3>(std::cbrt(q.si));
}

template <int Kg, int M, int S>
constexpr Quantity<Kg, M, S> abs(Quantity<Kg, M, S> q) {
  return q.si < 0.0 ? -q : q;
}

template <int Kg, int M, int S>
bool isfinite(Quantity<Kg, M, S> q) {
  return std::isfinite(q.si);
}

using Mass = Quantity<1, 0, 0>;
using Length = Quantity<0, 1, 0>;
using Area = Quantity<0, 2, 0>;
using Volume = Quantity<0, 3, 0>;
using Time = Quantity<0, 0, 1>;
using Velocity = Quantity<0, 1, -1>;
using Force = Quantity<1, 1, -2>;
using Energy = Quantity<1, 2, -2>;
using Torque = Quantity<1, 2, -2>;
using Stiffness = Quantity<1, 0, -2>;      // unit N/m
using SurfaceEnergy = Quantity<1, 0, -2>;  // unit J/m^2
using Pressure = Quantity<1, -1, -2>;
using Frequency = Quantity<0, 0, -1>;  // cycles per second, not rad/s
using Density = Quantity<1, -3, 0>;
using Viscosity = Quantity<1, -1, -1>;  // dynamic viscosity

// Kelvin. A separate type, because no other unit here includes it.
struct Temperature {
  double si = 0.0;

  constexpr Temperature() = default;
  constexpr explicit Temperature(double kelvin) : si(kelvin) {}
  constexpr auto operator<=>(const Temperature&) const = default;
};

// k_B T, by the exact Boltzmann constant of the SI.
constexpr Energy thermal_energy(Temperature temperature) { return Energy(1.380649e-23 * temperature.si); }

// 50.0_nm, 0.1_N_per_m, 24.5_zJ; for floating-point and integer literals. They divide by a power of ten, which is exact
// in a double, unlike the small factor, so that 1000_nm == 1_um.
namespace literals {

// NOLINTBEGIN(bugprone-macro-parentheses): a type cannot stand in parentheses
#define AFM_UNIT_LITERAL(suffix, type, per_si)                                                                  \
  constexpr type operator""_##suffix(long double value) { return type(static_cast<double>(value) / (per_si)); } \
  constexpr type operator""_##suffix(unsigned long long value) { return type(static_cast<double>(value) / (per_si)); }
// NOLINTEND(bugprone-macro-parentheses)

AFM_UNIT_LITERAL(m, Length, 1.0)
AFM_UNIT_LITERAL(mm, Length, 1e3)
AFM_UNIT_LITERAL(um, Length, 1e6)
AFM_UNIT_LITERAL(nm, Length, 1e9)
AFM_UNIT_LITERAL(pm, Length, 1e12)
AFM_UNIT_LITERAL(s, Time, 1.0)
AFM_UNIT_LITERAL(ms, Time, 1e3)
AFM_UNIT_LITERAL(kg, Mass, 1.0)
AFM_UNIT_LITERAL(m_per_s, Velocity, 1.0)
AFM_UNIT_LITERAL(um_per_s, Velocity, 1e6)
AFM_UNIT_LITERAL(N, Force, 1.0)
AFM_UNIT_LITERAL(nN, Force, 1e9)
AFM_UNIT_LITERAL(N_per_m, Stiffness, 1.0)
AFM_UNIT_LITERAL(J, Energy, 1.0)
AFM_UNIT_LITERAL(aJ, Energy, 1e18)
AFM_UNIT_LITERAL(zJ, Energy, 1e21)
AFM_UNIT_LITERAL(J_per_m2, SurfaceEnergy, 1.0)
AFM_UNIT_LITERAL(mJ_per_m2, SurfaceEnergy, 1e3)
AFM_UNIT_LITERAL(Pa, Pressure, 1.0)
AFM_UNIT_LITERAL(GPa, Pressure, 1e-9)
AFM_UNIT_LITERAL(Hz, Frequency, 1.0)
AFM_UNIT_LITERAL(kHz, Frequency, 1e-3)
AFM_UNIT_LITERAL(K, Temperature, 1.0)

#undef AFM_UNIT_LITERAL

}  // namespace literals

}  // namespace afm::physics
