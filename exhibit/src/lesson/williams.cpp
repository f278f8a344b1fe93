// SPDX-License-Identifier: Apache-2.0
#include "exhibit/lesson/williams.h"

namespace afm::exhibit {

std::vector<std::vector<std::size_t>> williams_orders(std::size_t conditions) {
  // the first order is 0, 1, n - 1, 2, n - 2 and so on, in which all differences are distinct
  std::vector<std::size_t> first;
  for (std::size_t place = 0; place < conditions; ++place) {
    const std::size_t step = (place + 1) / 2;
    first.push_back(place % 2 == 1 ? step : (conditions - step) % conditions);
  }
  std::vector<std::vector<std::size_t>> orders;
  for (std::size_t shift = 0; shift < conditions; ++shift) {
    std::vector<std::size_t>& order = orders.emplace_back();
    for (const std::size_t condition : first) order.push_back((condition + shift) % conditions);
  }
  if (conditions % 2 == 1 && conditions > 1) {
    for (std::size_t i = 0; i < conditions; ++i) orders.emplace_back(orders[i].rbegin(), orders[i].rend());
  }
  return orders;
}

}  // namespace afm::exhibit
