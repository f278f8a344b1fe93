// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>

namespace afm::support {

// True in the cases with the label deep, which check everything; the usual run draws fewer of the same cases.
inline bool deep() { return std::getenv("AFM_DEEP") != nullptr; }

// Number of random draws: all in a deep case, otherwise a tenth.
inline int draws(int all) { return deep() ? all : all / 10; }

}  // namespace afm::support
