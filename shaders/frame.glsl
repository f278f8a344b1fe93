// SPDX-License-Identifier: Apache-2.0
// The frame's block. Functions read it directly: an argument of its type would copy all members at every call, and a
// driver would spend milliseconds on each shader to find out which of the copies are needed.
#ifndef AFM_FRAME_GLSL
#define AFM_FRAME_GLSL

layout(set = 0, binding = AFM_BINDING_FRAME, std140) uniform Frame { FrameBlock frame; };

#endif
