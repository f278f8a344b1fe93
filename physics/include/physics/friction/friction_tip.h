// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>
#include <vector>

#include "physics/friction/anchored_tip.h"
#include "physics/friction/friction.h"
#include "physics/friction/lattice_tip.h"
#include "physics/friction/sideways.h"

// One tip type for each friction law. A new law adds its tip here and its row to kFrictionLaws
// (docs/adding-a-friction-law.md); an enumerator without a tip does not compile.
namespace afm::physics {

// Inputs for making a tip: one sample and its friction. `adhesion` is the magnitude of the pull-off force.
struct FrictionContact {
  const FrictionParameters& friction;  // validated parameters of the friction
  Law law;
  const ContactParameters& contact;
  Force adhesion;
};

// A tip that holds up to a yield force and then slides. `Yield` gives the force at a load:
//   static constexpr FrictionLaw kLaw;
//   static void check(const FrictionParameters&);  throws UnphysicalValue for a number that the law needs
//   explicit Yield(const FrictionContact&);        may allocate and throw std::invalid_argument
//   Force at(Force load) const noexcept;           in a tick of the servo
template <class Yield>
class SlidingTip {
 public:
  static constexpr FrictionLaw kLaw = Yield::kLaw;
  static void check(const FrictionParameters& friction) { Yield::check(friction); }
  explicit SlidingTip(const FrictionContact& at) : yield_(at), tip_(at.friction.lateral_stiffness) {}

  LatticeTip::Step touch_down(const Sideways<Length>& support, Force /*load*/) noexcept {
    tip_.land(support);
    return {};
  }
  LatticeTip::Step slide_to(const Sideways<Length>& support, Force load) noexcept {
    LatticeTip::Step step;
    step.lost = tip_.move_to(support, yield_.at(load));
    return step;
  }
  Sideways<Force> force() const noexcept { return tip_.force(); }
  Energy stored() const noexcept { return tip_.stored(); }
  Length lift_per_load() const noexcept { return {}; }

 private:
  Yield yield_;
  AnchoredTip tip_;
};

// Yield force mu N.
class AmontonsYield {
 public:
  static constexpr FrictionLaw kLaw = FrictionLaw::Amontons;
  static void check(const FrictionParameters& friction);
  explicit AmontonsYield(const FrictionContact& at) : coefficient_(at.friction.coefficient) {}
  Force at(Force load) const noexcept { return coefficient_ * load; }

 private:
  double coefficient_;
};

// Yield force tau A. Throws for a force law without a contact area.
class ContactAreaYield {
 public:
  static constexpr FrictionLaw kLaw = FrictionLaw::ContactArea;
  static void check(const FrictionParameters& friction);
  explicit ContactAreaYield(const FrictionContact& at);
  Force at(Force load) const noexcept;

 private:
  Pressure shear_strength_;
  std::vector<double> areas_m2_;  // contact areas at equal steps of the square root of the load
  double root_step_ = 1.0;        // step of the square root of the load, sqrt(N)
};

// A tip in the wells of a lattice, whose depth is proportional to the load.
class WellTip {
 public:
  static constexpr FrictionLaw kLaw = FrictionLaw::Lattice;
  static void check(const FrictionParameters& friction);
  explicit WellTip(const FrictionContact& at);

  LatticeTip::Step touch_down(const Sideways<Length>& support, Force load) noexcept {
    return tip_.land(support, scale(load));
  }
  LatticeTip::Step slide_to(const Sideways<Length>& support, Force load) noexcept {
    return tip_.move_to(support, scale(load));
  }
  Sideways<Force> force() const noexcept { return tip_.force(); }
  Energy stored() const noexcept { return tip_.stored(); }
  Length lift_per_load() const noexcept { return tip_.relief() * corrugation_; }

 private:
  Energy scale(Force load) const noexcept { return corrugation_ * load; }

  Length corrugation_;
  LatticeTip tip_;
};

using FrictionTip = std::variant<SlidingTip<AmontonsYield>, SlidingTip<ContactAreaYield>, WellTip>;

template <class... Tips>
constexpr bool has_tip(FrictionLaw law, const std::variant<Tips...>* /*of these*/) {
  return ((Tips::kLaw == law ? 1 : 0) + ...) == 1;
}
static_assert(
    [] {
      for (const FrictionLawText& row : kFrictionLaws) {
        const FrictionTip* tips = nullptr;
        if (row.law != FrictionLaw::None && !has_tip(row.law, tips)) return false;
      }
      return true;
    }(),
    "every law of friction needs one tip in FrictionTip");

// Throws std::invalid_argument for parameters out of range, for FrictionLaw::None and for an unknown law.
FrictionTip friction_tip(const FrictionContact& at);

}  // namespace afm::physics
