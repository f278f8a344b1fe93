// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>

namespace afm::support {

// True in the cases of label deep, which look at everything; the usual run draws fewer of the same.
inline bool deep() { return std::getenv("AFM_DEEP") != nullptr; }

// Number of random draws: all in a deep case, else a tenth.
inline int draws(int all) { return deep() ? all : all / 10; }

}  // namespace afm::support
