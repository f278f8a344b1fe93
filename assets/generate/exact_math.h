// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

// Arithmetic whose result is the same bits on every IEEE machine: + - * / and sqrt are rounded exactly, sin and cos are
// not. Circles come from bisecting unit vectors, noise from integer hashes.
namespace afm::generate {

struct V2 {
  double x = 0, y = 0;
};

struct V3 {
  double x = 0, y = 0, z = 0;
};

inline V2 operator+(V2 a, V2 b) { return {a.x + b.x, a.y + b.y}; }
inline V2 operator-(V2 a, V2 b) { return {a.x - b.x, a.y - b.y}; }
inline V2 operator*(V2 a, double s) { return {a.x * s, a.y * s}; }
inline double dot(V2 a, V2 b) { return a.x * b.x + a.y * b.y; }
inline V2 unit(V2 a) { return a * (1.0 / std::sqrt(dot(a, a))); }
inline bool operator==(V2 a, V2 b) { return a.x == b.x && a.y == b.y; }

inline V3 operator+(V3 a, V3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline V3 operator-(V3 a, V3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline V3 operator*(V3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline double dot(V3 a, V3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline V3 cross(V3 a, V3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline V3 unit(V3 a) { return a * (1.0 / std::sqrt(dot(a, a))); }
inline bool operator==(V3 a, V3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

inline double mix(double a, double b, double t) { return a + (b - a) * t; }
inline V3 mix(V3 a, V3 b, double t) { return a + (b - a) * t; }

// Smooth step: 0 below `low`, 1 above `high`, with zero slope and curvature at both.
double smooth_step(double low, double high, double value);

// Unit vectors from `from` to `to`, less than half a turn apart, in 2^halvings equal angles.
std::vector<V2> arc(V2 from, V2 to, int halvings);

// Random number, evenly spread over 0..1 and the same for the same arguments.
double random_unit(std::int64_t column, std::int64_t row, std::uint32_t seed);

// Smooth noise in -1..1 whose features are about one unit wide (value noise with a quintic fade).
double noise(double x, double y, std::uint32_t seed);

}  // namespace afm::generate
