// SPDX-License-Identifier: Apache-2.0
#include "fits/uncertainty.h"

#include <cmath>
#include <vector>

namespace afm::fits {

double error_share(double relative, const std::array<double, 2>& factors, const std::array<double, 2>& logarithms) {
  return relative * std::abs((logarithms[1] - logarithms[0]) / std::log(factors[1] / factors[0]));
}

double sum_of_shares(std::span<const double> shares) {
  double squares = 0.0;
  for (const double share : shares) squares += share * share;
  return std::sqrt(squares);
}

SystematicShares sum_of_shares(std::span<const Systematic> systematic) {
  std::vector<double> modulus, work;
  for (const Systematic& each : systematic) {
    modulus.push_back(each.modulus_share);
    work.push_back(each.work_share);
  }
  return {sum_of_shares(modulus), sum_of_shares(work)};
}

}  // namespace afm::fits
