// SPDX-License-Identifier: Apache-2.0
// render::Lighting::KeyAlone: the key light and an even light from all sides, without studio and shadow.
#ifndef AFM_ONE_LIGHT_GLSL
#define AFM_ONE_LIGHT_GLSL

layout(constant_id = AFM_CONSTANT_ONE_LIGHT) const bool kOneLight = false;
const vec3 kEvenLight = vec3(0.15);

#endif
