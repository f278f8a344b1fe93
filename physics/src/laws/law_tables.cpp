// SPDX-License-Identifier: Apache-2.0
#include "physics/law_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "laws/equilibrium_branch.h"
#include "laws/paper_tables.h"
#include "physics/force_laws.h"
#include "physics/quantity_text.h"

namespace afm::physics {
namespace {

// The validated parameters of the law itself. An infinite k_c, for fixed grips, is legal only here, and no law uses it.
ContactParameters without_lever(ContactParameters contact) {
  if (std::isinf(contact.spring_constant.si) && contact.spring_constant.si > 0.0) {
    contact.spring_constant = Stiffness(1.0);
  }
  validate(contact);
  return contact;
}

double compliance(const ContactParameters& contact) {
  return 1.0 / contact.spring_constant.si + 1.0 / contact.sample_stiffness.si;
}

// A rest position of the tip, SI, and its parameter on the branch.
struct Rest {
  double z = 0.0;
  double force = 0.0;
  double s = 0.0;
};

// Returns whether a law is single-valued in h: its attached branch then extends to the beginning of the free one.
bool is_single_valued(const ForceLaw& law) {
  const double farthest = law.free.at(law.free.first).h.si;
  return std::abs(law.attached.at(law.attached.last).h.si - farthest) < 1e-6 * farthest;
}

class Builder {
 public:
  Builder(Law name, const ForceLaw& law, const ContactParameters& contact)
      : law_(law),
        single_valued_(is_single_valued(law)),
        free_curve_(single_valued_ ? reversed(law.attached) : law.free),
        compliance_(compliance(contact)),
        free_(free_curve_, compliance_, EquilibriumBranch::Direction::Inwards),
        attached_(law.attached, compliance_, EquilibriumBranch::Direction::Outwards) {
    tables_.law = name;
    tables_.contact = contact;
    tables_.contact_gap = law.contact_gap;
  }

  LawTables build() {
    CycleFigures& figures = tables_.figures;
    // a loop narrower than rounding does not count, nor do two adjacent loops
    figures.hysteretic = !single_valued_ || (free_.folded() && attached_.folded() &&
                                             attached_.at(attached_.end()).z > free_.at(free_.end()).z);
    figures.critical_stiffness = critical_stiffness();
    if (figures.hysteretic) {
      solve_jumps();
    } else {
      meet_at_contact();
    }
    set_tip_heights();
    tabulate();
    return std::move(tables_);
  }

 private:
  Rest rest(const EquilibriumBranch& branch, double s) const {
    const EquilibriumBranch::Point point = branch.at(s);
    return {point.z, point.force, s};
  }

  Stiffness critical_stiffness() const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (!single_valued_) return Stiffness(kInfinity);
    const double steepest = std::max(steepest_attraction(law_.free), steepest_attraction(law_.attached));
    if (steepest <= 0.0) return Stiffness();
    const double lever_compliance = 1.0 / steepest - 1.0 / tables_.contact.sample_stiffness.si;
    return Stiffness(lever_compliance > 0.0 ? 1.0 / lever_compliance : kInfinity);
  }

  void meet_at_contact() {
    const LawPoint touch = law_.free.at(law_.free.last);
    const double z = touch.h.si - compliance_ * touch.force.si;
    free_.cut_at(free_.at_z(z).value_or(free_.end()));
    attached_.cut_at(attached_.at_z(z).value_or(attached_.end()));
    const Rest contact{z, touch.force.si, 0.0};
    CycleFigures& figures = tables_.figures;
    figures.z_jtc = figures.z_joc = Length(contact.z);
    figures.force_before_jtc = figures.force_after_jtc = Force(contact.force);
    figures.force_before_joc = figures.force_after_joc = Force(contact.force);
  }

  void solve_jumps() {
    const Rest in_from = rest(free_, free_.end());
    const Rest off_from = rest(attached_, attached_.end());
    const auto in_to_s = attached_.at_z(in_from.z);
    if (in_from.z < attached_.at(law_.attached.first).z) {
      throw std::invalid_argument("the sample is too soft: a tip that jumps to contact at " +
                                  format_quantity(Length(in_from.z), kLengthUnits) + " would sink in by more than " +
                                  format_quantity(-law_.attached.at(law_.attached.first).h, kLengthUnits));
    }
    if (off_from.z <= in_from.z || !in_to_s) {
      throw std::invalid_argument(
          "the adhesion is too weak: jump-off-contact at " + format_quantity(Length(off_from.z), kLengthUnits) +
          " does not lie above jump-to-contact at " + format_quantity(Length(in_from.z), kLengthUnits));
    }
    const Rest in_to = rest(attached_, *in_to_s);
    const auto off_to_s = free_.at_z(off_from.z);
    const Rest off_to = off_to_s ? rest(free_, *off_to_s) : rest_beyond_law(off_from.z);

    CycleFigures& figures = tables_.figures;
    figures.z_jtc = Length(in_from.z);
    figures.force_before_jtc = Force(in_from.force);
    figures.force_after_jtc = Force(in_to.force);
    figures.z_joc = Length(off_from.z);
    figures.force_before_joc = Force(off_from.force);
    figures.force_after_joc = Force(off_to.force);

    const double fall_of_free = potential_rise(free_curve_, off_to.s, in_from.s);
    const double rise_of_attached = potential_rise(law_.attached, in_to.s, off_from.s);
    const double loop =
        fall_of_free + rise_of_attached + stored(in_from) - stored(in_to) + stored(off_from) - stored(off_to);
    figures.loop_energy = Energy(single_valued_ ? std::max(0.0, loop) : loop);
    figures.lost_at_jtc = lost_at_jtc(in_from, in_to, figures.loop_energy);
    figures.lost_at_joc = figures.loop_energy - figures.lost_at_jtc;
  }

  // Energy stored in lever and support.
  double stored(const Rest& rest) const { return 0.5 * compliance_ * rest.force * rest.force; }

  Energy lost_at_jtc(const Rest& from, const Rest& to, Energy loop) const {
    if (single_valued_) {
      // drop along the single curve; cannot be negative apart from rounding
      const double lost = potential_rise(law_.attached, to.s, -from.s) + stored(from) - stored(to);
      return Energy(std::clamp(lost, 0.0, loop.si));
    }
    // without a potential the two jumps cannot be separated: assumes a well that is just deep enough for the first one
    if (!law_.attached_end_potential) return Energy();
    const double u_from = potential_far_away() + potential_rise(law_.free, law_.free.first, from.s);
    const double u_to = law_.attached_end_potential->si - potential_rise(law_.attached, to.s, law_.attached.last);
    return Energy(u_from + stored(from) - u_to - stored(to));
  }

  // The force continues beyond the first point of the free branch as the same power of h.
  static double falling_exponent(const LawPoint& far) { return -far.dforce_ds / far.dh_ds * far.h.si / far.force.si; }

  // Rest of a lever that is so soft that it releases the tip beyond the law's last point.
  Rest rest_beyond_law(double z) const {
    const LawPoint far = free_curve_.at(free_curve_.first);
    const double force = far.force.si == 0.0 ? 0.0 : far.force.si * std::pow(far.h.si / z, falling_exponent(far));
    return {z, force, free_curve_.first};
  }

  // U at the first point of the free branch.
  double potential_far_away() const {
    const LawPoint far = law_.free.at(law_.free.first);
    if (far.force.si == 0.0) return 0.0;
    return far.force.si * far.h.si / (falling_exponent(far) - 1.0);
  }

  void set_tip_heights() {
    CycleFigures& figures = tables_.figures;
    const auto height = [this](Length z, Force force) { return z + force / tables_.contact.spring_constant; };
    figures.tip_height_before_jtc = height(figures.z_jtc, figures.force_before_jtc);
    figures.tip_height_after_jtc = height(figures.z_jtc, figures.force_after_jtc);
    figures.tip_height_before_joc = height(figures.z_joc, figures.force_before_joc);
    figures.tip_height_after_joc = height(figures.z_joc, figures.force_after_joc);
  }

  void tabulate() {
    // beyond, the table extrapolates a branch: ten times the cycle, and enough for a stroke of a few micrometres
    constexpr double kShortest = 4e-6;  // shortest reach of a table, m
    const double reach = std::max(kShortest, 10.0 * std::abs(tables_.figures.z_joc.si));
    tables_.free = free_.table(reach);
    tables_.attached = attached_.table(reach);
  }

  const ForceLaw& law_;
  bool single_valued_;
  // for a single-valued law the reversed attached branch: an approaching tip follows that one curve until it folds,
  // before or after contact
  LawBranch free_curve_;
  double compliance_;
  EquilibriumBranch free_;
  EquilibriumBranch attached_;
  LawTables tables_;
};

}  // namespace

std::shared_ptr<const LawTables> build_law_tables(Law name, const ForceLaw& law, const ContactParameters& contact) {
  without_lever(contact);
  return std::make_shared<const LawTables>(Builder(name, law, contact).build());
}

std::shared_ptr<const LawTables> build_law_tables(Law law, const ContactParameters& contact,
                                                  const LawOptions& options) {
  const ContactParameters surfaces = without_lever(contact);
  if (!has_dynamics(law) && compliance(contact) == 0.0) {
    throw std::invalid_argument("the law " + std::string(name_of(law)) +
                                " has a rigid contact, which has no force without a lever");
  }
  if (law == Law::Paper) return std::make_shared<const LawTables>(paper_tables(contact));
  return build_law_tables(law, force_law(law, surfaces, options), contact);
}

}  // namespace afm::physics
