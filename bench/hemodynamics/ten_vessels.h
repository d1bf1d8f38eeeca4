#pragma once
/// \file A coronary tree of ten vessels.

#include "flow_networks.h"

namespace ostia::bench {

/// Left and right tree, ten named vessels in 17 branches, sections 0.5 mm apart, two stenoses.
inline hemodynamics::Network ten_vessels(double least = 0.45) {
  hemodynamics::Network network;
  const auto add = [&](double length, double radius, int parent, double angle, double narrowing = 1.0) {
    network.branches.push_back(
        testing::vessel_of(length, testing::narrowed(radius, 0.5 * length, 10.0, narrowing), parent));
    network.branches.back().angle_rad = angle;
    for (auto& station : network.branches.back().stations) station.curvature_per_mm = 0.02;
    return static_cast<int>(network.branches.size()) - 1;
  };
  const int lm = add(10, 2.2, -1, 0.0);
  const int lad = add(25, 1.8, lm, 0.4, least), lcx = add(20, 1.7, lm, -0.7);
  const int lad2 = add(25, 1.6, lad, 0.1);
  add(40, 1.1, lad, 0.8);  // D1
  const int lad3 = add(20, 1.4, lad2, 0.1);
  add(35, 0.9, lad2, 0.7);  // D2
  add(50, 1.2, lad3, 0.1);
  add(25, 0.8, lad3, -0.8);  // septal
  const int lcx2 = add(25, 1.5, lcx, 0.1, 0.6);
  add(40, 1.1, lcx, -0.6);  // OM1
  add(30, 1.1, lcx2, 0.2);
  add(35, 1.0, lcx2, -0.6);  // OM2
  const int rca = add(50, 1.9, -1, 0.0);
  const int rca2 = add(50, 1.7, rca, 0.1);
  add(30, 0.9, rca, 0.8);  // AM
  add(45, 1.3, rca2, 0.3);
  add(40, 1.1, rca2, -0.4);
  return network;
}

}  // namespace ostia::bench
