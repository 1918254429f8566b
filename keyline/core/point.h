#pragma once

#include <cmath>

namespace keyline::core {

/// Planar vector: a displacement, tangent or normal.
struct Vector2 {
  double x = 0;
  double y = 0;
  friend bool operator==(const Vector2&, const Vector2&) = default;
};

/// Planar point, in the document's unit.
struct Point2 {
  double x = 0;
  double y = 0;
  friend bool operator==(const Point2&, const Point2&) = default;
};

/// Vector in space.
struct Vector3 {
  double x = 0;
  double y = 0;
  double z = 0;
  friend bool operator==(const Vector3&, const Vector3&) = default;
};

/// Point in space, in the document's unit.
struct Point3 {
  double x = 0;
  double y = 0;
  double z = 0;
  friend bool operator==(const Point3&, const Point3&) = default;
};

constexpr Vector2 operator+(Vector2 a, Vector2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vector2 operator-(Vector2 a, Vector2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vector2 operator-(Vector2 a) { return {-a.x, -a.y}; }
constexpr Vector2 operator*(double k, Vector2 a) { return {k * a.x, k * a.y}; }
constexpr Vector2 operator*(Vector2 a, double k) { return k * a; }
constexpr Vector2 operator/(Vector2 a, double k) { return {a.x / k, a.y / k}; }
constexpr Point2 operator+(Point2 p, Vector2 v) { return {p.x + v.x, p.y + v.y}; }
constexpr Point2 operator-(Point2 p, Vector2 v) { return {p.x - v.x, p.y - v.y}; }
constexpr Vector2 operator-(Point2 a, Point2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr double dot(Vector2 a, Vector2 b) { return a.x * b.x + a.y * b.y; }
/// z component of the cross product: positive when b lies counter-clockwise of a.
constexpr double cross(Vector2 a, Vector2 b) { return a.x * b.y - a.y * b.x; }
inline double norm(Vector2 a) { return std::hypot(a.x, a.y); }
inline double distance(Point2 a, Point2 b) { return norm(b - a); }
/// a turned by a quarter counter-clockwise.
constexpr Vector2 perpendicular_left(Vector2 a) { return {-a.y, a.x}; }
/// (1 - u) a + u b.
constexpr Point2 mix(Point2 a, Point2 b, double u) {
  return {(1 - u) * a.x + u * b.x, (1 - u) * a.y + u * b.y};
}

constexpr Vector3 operator+(Vector3 a, Vector3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vector3 operator-(Vector3 a, Vector3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vector3 operator-(Vector3 a) { return {-a.x, -a.y, -a.z}; }
constexpr Vector3 operator*(double k, Vector3 a) { return {k * a.x, k * a.y, k * a.z}; }
constexpr Vector3 operator*(Vector3 a, double k) { return k * a; }
constexpr Vector3 operator/(Vector3 a, double k) { return {a.x / k, a.y / k, a.z / k}; }
constexpr Point3 operator+(Point3 p, Vector3 v) { return {p.x + v.x, p.y + v.y, p.z + v.z}; }
constexpr Point3 operator-(Point3 p, Vector3 v) { return {p.x - v.x, p.y - v.y, p.z - v.z}; }
constexpr Vector3 operator-(Point3 a, Point3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr double dot(Vector3 a, Vector3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vector3 cross(Vector3 a, Vector3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(Vector3 a) { return std::hypot(a.x, a.y, a.z); }
inline double distance(Point3 a, Point3 b) { return norm(b - a); }
/// (1 - u) a + u b.
constexpr Point3 mix(Point3 a, Point3 b, double u) {
  return {(1 - u) * a.x + u * b.x, (1 - u) * a.y + u * b.y, (1 - u) * a.z + u * b.z};
}

inline bool is_finite(Point2 p) { return std::isfinite(p.x) && std::isfinite(p.y); }
inline bool is_finite(Vector2 v) { return std::isfinite(v.x) && std::isfinite(v.y); }
inline bool is_finite(Point3 p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}
inline bool is_finite(Vector3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Vector type that belongs to a point type: Displacement<Point2> is Vector2.
template <class Point>
using Displacement = decltype(Point{} - Point{});

}  // namespace keyline::core
