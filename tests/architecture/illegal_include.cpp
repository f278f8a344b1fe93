// SPDX-License-Identifier: Apache-2.0
// Compiled with the include path that physics has: as it stands it compiles, with AFM_ILLEGAL it must not.
#include "physics/units.h"
#ifdef AFM_ILLEGAL
#include "render/renderer.h"
#endif

int main() { return 0; }
