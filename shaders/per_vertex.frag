// SPDX-License-Identifier: Apache-2.0
#version 460

layout(location = 0) in vec3 shown;
layout(location = 0) out vec4 out_color;

void main() { out_color = vec4(shown, 1.0); }
