#pragma once
/// \file A mesh cut open, with its edges.

#include "ostia/figure/scene.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ostia::bench {

/// Faces of three or four corners that are shown in one colour.
struct CutPart {
  std::string label;
  figure::Color color;
  std::vector<std::vector<std::int32_t>> faces{};
};

inline figure::Scene cut_scene(const std::vector<geometry::Vec3>& points, const std::vector<CutPart>& parts) {
  figure::Scene scene;
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (const CutPart& part : parts) {
    figure::MeshActor actor;
    actor.mesh.points = points;
    actor.color = part.color;
    actor.label = part.label;
    actor.shading = figure::Shading::flat;
    for (const auto& f : part.faces) {
      actor.mesh.triangles.push_back({f[0], f[1], f[2]});
      if (f.size() == 4) actor.mesh.triangles.push_back({f[0], f[2], f[3]});
      for (std::size_t i = 0; i < f.size(); ++i) edges.insert(std::minmax({f[i], f[(i + 1) % f.size()]}));
    }
    scene.meshes.push_back(std::move(actor));
  }
  for (const auto& [a, b] : edges)
    scene.tubes.push_back({{points[static_cast<std::size_t>(a)], points[static_cast<std::size_t>(b)]},
                           {0.012},
                           {0.06, 0.07, 0.09, 1.0}});
  return scene;
}

}  // namespace ostia::bench
