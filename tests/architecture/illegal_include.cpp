// SPDX-License-Identifier: Apache-2.0
// Compiled with the include path of physics: must compile as it is, and fail with AFM_ILLEGAL.
#include "physics/units.h"
#ifdef AFM_ILLEGAL
#include "render/renderer.h"
#endif

int main() { return 0; }
