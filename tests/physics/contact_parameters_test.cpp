// SPDX-License-Identifier: Apache-2.0
#include "physics/contact_parameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "physics/law.h"

namespace afm::physics {
namespace contact_parameters_test {

using namespace literals;

ContactParameters mica() {
  ContactParameters contact{50_nm, 0.1_N_per_m, Stiffness(HUGE_VAL), 24.5_zJ, 2.228_mJ_per_m2};
  contact.reduced_modulus = 51.5_GPa;
  return contact;
}

template <class Value>
std::string refusal(const Value& value, const std::string& field) {
  try {
    validate(value);
  } catch (const UnphysicalValue& error) {
    EXPECT_EQ(error.field(), field);
    return error.what();
  }
  ADD_FAILURE() << field << " was not refused";
  return "";
}

TEST(ValidateInteraction, TakesARigidContactAndTheEndsOfTheRanges) {
  for (const Pressure modulus : {Pressure(HUGE_VAL), 1_Pa, 10000_GPa}) {
    ContactParameters m = mica();
    m.reduced_modulus = modulus;
    EXPECT_NO_THROW(validate(m));
  }
  for (const Length z0 : {0.05_nm, 5_nm}) {
    ContactParameters m = mica();
    m.atomic_distance = z0;
    EXPECT_NO_THROW(validate(m));
  }
}

TEST(ValidateInteraction, RefusesAModulusOfNothingAndSaysWhy) {
  for (const double bad : {-1.0, 0.0, 0.99, 1.01e13, 1e30, std::nan(""), -HUGE_VAL}) {
    ContactParameters m = mica();
    m.reduced_modulus = Pressure(bad);
    refusal(m, "reduced_modulus");
  }
  ContactParameters m = mica();
  m.reduced_modulus = Pressure(1e30);
  EXPECT_EQ(refusal(m, "reduced_modulus"), "reduced modulus 1e+18 TPa is not within 1 Pa to 10 TPa");
}

TEST(ValidateInteraction, RefusesAnAtomicDistanceOfNoAtom) {
  for (const double bad : {-1e-10, 0.0, 4.9e-11, 5.1e-9, 0.3, std::nan(""), HUGE_VAL}) {
    ContactParameters m = mica();
    m.atomic_distance = Length(bad);
    refusal(m, "atomic_distance");
  }
}

TEST(ValidateOptions, RefusesWhatNoLiquidAndNoSpectrumHas) {
  LawOptions options;
  EXPECT_NO_THROW(validate(options));
  options.meniscus = Meniscus{};
  options.retardation_wavelength = 100_nm;
  EXPECT_NO_THROW(validate(options));
  for (const double bad : {0.0, -1e-7, 1e-3, std::nan(""), HUGE_VAL}) {
    options.retardation_wavelength = Length(bad);
    refusal(options, "retardation_wavelength");
  }
  options.retardation_wavelength.reset();
  for (const double bad : {0.0, 1.0, 50.0, std::nan("")}) {
    options.meniscus = Meniscus{.relative_humidity = bad};
    refusal(options, "relative_humidity");
  }
  for (const double bad : {-0.1, 1.6, 90.0, std::nan("")}) {
    options.meniscus = Meniscus{.contact_angle_rad = bad};
    refusal(options, "contact_angle_rad");
  }
  options.meniscus = Meniscus{.surface_tension = SurfaceEnergy(72.8)};
  EXPECT_EQ(refusal(options, "surface_tension"), "surface tension 72.8 J/m2 is not within 0.1 mJ/m2 to 10 J/m2");
}

}  // namespace contact_parameters_test
}  // namespace afm::physics
