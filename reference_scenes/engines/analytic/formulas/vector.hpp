// Vectors of any number type, for the .cpp files of this folder.
#pragma once

#include <cmath>
#include <utility>

#include "base/words/vec.hpp"

namespace lobelia::truth {

template <class Real>
struct Vector {
  Real x = 0, y = 0, z = 0;
  Vector() = default;
  Vector(Real x_, Real y_, Real z_) : x(std::move(x_)), y(std::move(y_)), z(std::move(z_)) {}
  explicit Vector(Vec3 v) : x(v.x), y(v.y), z(v.z) {}
  friend Vector operator+(const Vector& a, const Vector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend Vector operator-(const Vector& a, const Vector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend Vector operator-(const Vector& a) { return {-a.x, -a.y, -a.z}; }
  friend Vector operator*(const Real& k, const Vector& a) { return {k * a.x, k * a.y, k * a.z}; }
};

template <class Real>
Real dot(const Vector<Real>& a, const Vector<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
Vector<Real> cross(const Vector<Real>& a, const Vector<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Real>
Vector<Real> normalize(const Vector<Real>& a) {
  using std::sqrt;
  return Real(1 / sqrt(dot(a, a))) * a;
}

}  // namespace lobelia::truth
