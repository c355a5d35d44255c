// SPDX-License-Identifier: MIT
// The scene as FCL needs it: one CollisionObject per sphere, one geometry per distinct radius.
#pragma once

#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision_object.h>

#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/sphere.hpp"

#ifdef __AVX__
#error "libfcl is packaged without AVX; with it Eigen would lay out the same classes differently."
#endif

namespace octocell::baselines {

class FclObjects {
 public:
  using Object = fcl::CollisionObjectd;

  /// Makes one object per sphere and computes its box.
  void make(std::span<const Sphere> spheres) {
    objects_.clear();
    pointers_.clear();
    objects_.reserve(spheres.size());
    pointers_.reserve(spheres.size());
    Geometries geometries;
    for (const Sphere& s : spheres) {
      objects_.emplace_back(geometry(geometries, s.r), fcl::Matrix3d::Identity(), centre(s));
      pointers_.push_back(&objects_.back());
    }
  }

  /// Replaces the objects whose radius changed, because an object's geometry cannot be exchanged.
  /// They keep their addresses, by which managers know them. Call move() next.
  void change_radii(std::span<const Sphere> spheres) {
    Geometries geometries;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      if (radius(objects_[i]) == static_cast<double>(spheres[i].r)) continue;
      objects_[i] =
          Object(geometry(geometries, spheres[i].r), fcl::Matrix3d::Identity(), centre(spheres[i]));
    }
  }

  /// Moves the objects. FCL does not read a transform again by itself: without computeAABB() boxes
  /// stay where they were.
  void move(std::span<const Sphere> spheres) {
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      objects_[i].setTranslation(centre(spheres[i]));
      objects_[i].computeAABB();
    }
  }

  [[nodiscard]] const std::vector<Object*>& pointers() const { return pointers_; }
  [[nodiscard]] const Object* first() const { return objects_.data(); }

  static double radius(const Object& object) {
    return static_cast<const fcl::Sphered&>(*object.collisionGeometry()).radius;
  }

 private:
  using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;
  using Geometries = std::unordered_map<float, Geometry>;

  static const Geometry& geometry(Geometries& geometries, float r) {
    Geometry& shared = geometries[r];
    if (!shared) shared = std::make_shared<fcl::Sphered>(static_cast<double>(r));
    return shared;
  }
  static fcl::Vector3d centre(const Sphere& s) { return {s.x, s.y, s.z}; }

  std::vector<Object> objects_;    // [sphere]
  std::vector<Object*> pointers_;  // [sphere] pointers into objects_, which FCL's functions take
};

}  // namespace octocell::baselines
