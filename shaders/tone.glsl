// SPDX-License-Identifier: Apache-2.0
// Khronos PBR Neutral tone mapping: base colours up to 0.76 are unchanged, so that gold looks like its samples;
// brighter ones roll off to white (Khronos Group, "PBR Neutral Tone Mapper", 2024). Linear in, display-linear 0..1 out.
vec3 tone_map(vec3 color) {
  const float compression_start = 0.76;
  const float desaturation = 0.15;
  float darkest = min(color.r, min(color.g, color.b));
  color -= darkest < 0.08 ? darkest - 6.25 * darkest * darkest : 0.04;
  float peak = max(color.r, max(color.g, color.b));
  if (peak < compression_start) {
    return color;
  }
  const float room = 1.0 - compression_start;
  float new_peak = 1.0 - room * room / (peak + room - compression_start);
  color *= new_peak / peak;
  float whiteness = 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0);
  return mix(color, vec3(new_peak), whiteness);
}

// The sRGB curve (IEC 61966-2-1). The eye images contain encoded values in a UNORM format, so that a pixel's samples
// and blended primitives mix as the viewer sees them, and a CPU device encodes once per pixel instead of once per
// sample. The power 1/2.4 is a least-squares fit in square roots, which are cheaper, within 0.2 of an 8-bit step for
// 0..1.
vec3 srgb_from_linear(vec3 c) {
  vec3 root = sqrt(max(c, 0.0));
  vec3 curve = -0.0770821 - 0.0555908 * c + 0.8330840 * root + 0.2989871 * sqrt(root);
  return mix(c * 12.92, curve, greaterThan(c, vec3(0.0031308)));
}
