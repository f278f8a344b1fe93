// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <type_traits>
#include <utility>

#include "core/result.h"

namespace afm::instrument {

// A request that is answered with its reason.
struct RefusedRequest : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The value of a result; throws RefusedRequest with the error's message.
template <class T>
T value_of(core::Result<T> result) {
  if (!result) throw RefusedRequest(result.error().message);
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

// Limit of positions and heights that a client can name, in either direction.
inline constexpr double kMostPlaceM = 1e-3;

}  // namespace afm::instrument
