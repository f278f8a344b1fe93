// SPDX-License-Identifier: Apache-2.0
// Khronos PBR Neutral tone mapping: base colours up to 0.76 stay as they are, so that gold looks like its samples; what
// is brighter rolls off to white (Khronos Group, "PBR Neutral Tone Mapper", 2024). Linear in, display-linear 0..1 out.
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
