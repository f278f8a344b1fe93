// SPDX-License-Identifier: Apache-2.0
#include "physics/contact_parameters.h"
#include "physics/units.h"

// Compiled by tests, never linked: AFM_CASE picks one line that must be refused.
using namespace afm::physics;
using namespace afm::physics::literals;

Length sum = 1_nm + 2_um;
Force hooke = 0.1_N_per_m * 10_nm;
Length root = cbrt(8_nm * 1_nm * 1_nm);
double ratio = 1_nm / 1_um;
bool shorter = 1_nm < 1_um;

#ifdef AFM_CASE
#if AFM_CASE == 1
auto wrong = 1_nN + 1_nm;
#elif AFM_CASE == 2
Force wrong = 0.1_N_per_m;
#elif AFM_CASE == 3
bool wrong = 1_s < 1_nm;
#elif AFM_CASE == 4
Length wrong = 1e-9;
#elif AFM_CASE == 5
ContactParameters wrong{50e-9, 0.1, 1e9, 2.45e-20, 2.228e-3};
#elif AFM_CASE == 6
auto wrong = cbrt(1_nm * 1_nm);
#endif
#endif
