// SPDX-License-Identifier: Apache-2.0
// Reflectance of a surface under a thin film: L. Belcour and P. Barla, "A Practical Extension to Microfacet Theory for the
// Modeling of Varying Iridescence" (SIGGRAPH 2017), in the form that KHR_materials_iridescence gives it: two orders of the
// Airy summation, the eye's sensitivity as Gaussians over the path difference.

float film_squared(float x) { return x * x; }

// The eye's response to interference with this path difference, in linear sRGB.
vec3 film_sensitivity(float path_m, vec3 shift) {
  float phase = 2.0 * 3.14159265 * path_m;
  const vec3 value = vec3(5.4856e-13, 4.4201e-13, 5.2481e-13);
  const vec3 position = vec3(1.6810e+06, 1.7953e+06, 2.2084e+06);
  const vec3 variance = vec3(4.3278e+09, 9.3046e+09, 6.6121e+09);
  vec3 xyz = value * sqrt(2.0 * 3.14159265 * variance) * cos(position * phase + shift) *
             exp(-phase * phase * variance);
  xyz.x += 9.7470e-14 * sqrt(2.0 * 3.14159265 * 4.5282e+09) * cos(2.2399e+06 * phase + shift.x) *
           exp(-4.5282e+09 * phase * phase);
  xyz /= 1.0685e-7;
  return mat3(3.2404542, -0.9692660, 0.0556434,
              -1.5371385, 1.8760108, -0.2040259,
              -0.4985314, 0.0415560, 1.0572252) * xyz;
}

vec3 schlick(vec3 f0, float cosine) { return f0 + (1.0 - f0) * pow(clamp(1.0 - cosine, 0.0, 1.0), 5.0); }

vec3 thin_film_reflectance(float film_ior, float cosine, float thickness_m, vec3 base) {
  // without thickness there is no film
  float ior = mix(1.0, film_ior, smoothstep(0.0, 30e-9, thickness_m));
  float sine2 = film_squared(1.0 / ior) * (1.0 - cosine * cosine);
  if (sine2 >= 1.0) {
    return vec3(1.0);
  }
  float inner_cosine = sqrt(1.0 - sine2);

  // air to film, and film to base
  float f0 = film_squared((ior - 1.0) / (ior + 1.0));
  float r12 = schlick(vec3(f0), cosine).x;
  float t121 = 1.0 - r12;
  float shift21 = ior < 1.0 ? 0.0 : 3.14159265;
  vec3 root = sqrt(clamp(base, 0.0, 0.9999));
  vec3 base_ior = (1.0 + root) / (1.0 - root);
  vec3 f1 = (base_ior - ior) / (base_ior + ior);
  vec3 r23 = schlick(f1 * f1, inner_cosine);
  vec3 shift = vec3(shift21) + mix(vec3(0.0), vec3(3.14159265), lessThan(base_ior, vec3(ior)));
  float path_m = 2.0 * ior * thickness_m * inner_cosine;

  vec3 r123 = clamp(r12 * r23, 1e-5, 0.9999);
  vec3 single = film_squared(t121) * r23 / (1.0 - r123);
  vec3 sum = r12 + single;
  vec3 amplitude = single - t121;
  for (int order = 1; order <= 2; ++order) {
    amplitude *= sqrt(r123);
    sum += amplitude * 2.0 * film_sensitivity(float(order) * path_m, float(order) * shift);
  }
  return max(sum, vec3(0.0));
}
