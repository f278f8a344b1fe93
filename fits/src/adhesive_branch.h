// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fits/indenter.h"
#include "physics/adhesive_contact.h"

namespace afm::fits {

// A tip that sticks by DMT, JKR or Maugis, with a lever in series (docs/fits.md). All three are curves in Maugis' units
// (physics/maugis_dugdale.h) along a parameter s that grows outwards, so that the derivatives by modulus and work of
// adhesion follow from those units.
class AdhesiveBranch {
 public:
  // `law` has ShapeRow::is_adhesive and is not Auto. The lever's stiffness in N/m.
  AdhesiveBranch(Shape law, const physics::AdhesiveContact& contact, double atomic_distance_m, double spring_n_per_m);

  struct Held {
    double depth_m = 0, force_n = 0;
    double by_modulus_n = 0, by_work_n = 0;  // derivatives by the logarithms of modulus and work
    double by_contact_n_per_m = 0;           // derivative by the contact point
  };

  // State at the way z_c - Z, depth plus the lever's deflection. `near`: parameter of a neighbouring way, from which
  // the search begins; set to that of this one. Beyond the fold, where the lever would jump, the tip stays at its depth
  // and the lever bends on.
  Held at(double way_m, double& near) const;

  double fold() const { return fold_; }

  // Way at the fold, the smallest of the branch; negative.
  double fold_way_m() const { return way_m(point(lambda_, fold_)); }

  // Strongest pull of a soft lever, a magnitude: 2 pi W R for DMT, 3/2 pi W R for JKR.
  double pull_off_n() const;

  // Way at the fold, where the lever jumps off; negative.
  double let_go_way_m() const { return way_m(point(lambda_, fold_)); }

 private:
  struct Point {
    double load, indentation;    // load and indentation in Maugis' units
    double dload, dindentation;  // derivatives by s
  };
  Point point(double lambda, double s) const;
  double way_m(const Point& point) const;
  double way_slope_m(const Point& point) const;
  double solve(double way_m, double near) const;
  double find_fold() const;

  Shape law_;
  double lambda_, spring_n_per_m_, load_n_, indentation_m_, fold_;
};

// Tabor parameter mu = (R W^2/(E*^2 z0^3))^(1/3) (Tabor 1977).
double tabor_of(const physics::AdhesiveContact& contact, double atomic_distance_m);

// Law for a Tabor parameter by the borders of Johnson & Greenwood 1997 (physics/adhesion_map.h).
Shape law_of_tabor(double tabor);

}  // namespace afm::fits
