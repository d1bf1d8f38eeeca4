#pragma once
/// \file Points, vectors and boxes. World coordinates are DICOM's LPS, in millimetres.

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ostia::geometry {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Box3 = Eigen::AlignedBox3d;

}  // namespace ostia::geometry
