// SPDX-License-Identifier: Apache-2.0
#include "app/law_request.h"

#include <fmt/format.h>

#include <string_view>

#include "physics/dynamic_model.h"

namespace afm::app {

namespace {
constexpr std::string_view kDynamic = "dynamic-";
constexpr std::string_view kAuto = "auto";
}  // namespace

core::Result<LawRequest> law_request(const std::string& model) {
  LawRequest request;
  std::string_view name = model;
  request.dynamic = name.starts_with(kDynamic);
  if (request.dynamic) name.remove_prefix(kDynamic.size());
  request.law = physics::law_of(name);
  const bool known = name == kAuto || (request.law && *request.law != physics::Law::Measured &&
                                       (!request.dynamic || physics::has_dynamics(*request.law)));
  if (!known) {
    return core::failure(
        core::ErrorCategory::WrongUsage,
        fmt::format("unknown model \"{}\"; known are auto, paper, hao, hertz, dmt, jkr, maugis, lj, and "
                    "dynamic- before auto, hertz, dmt, jkr, maugis or lj",
                    model));
  }
  return request;
}

std::string name_of(const LawRequest& request) {
  return fmt::format("{}{}", request.dynamic ? kDynamic : "", request.law ? physics::name_of(*request.law) : kAuto);
}

}  // namespace afm::app
