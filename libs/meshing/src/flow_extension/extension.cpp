#include "flow_extension/extension.h"

#include "ostia/core/error.h"

#include <cmath>
#include <numbers>

namespace ostia::meshing {

using geometry::Vec3;

ExtensionAxis axis_of(const Extension& e) {
  if (e.through.empty() && e.bend_deg <= 0.0) return ExtensionAxis(e.section);
  const ExtensionAxis axis =
      e.through.empty() ? ExtensionAxis(e.section, e.wanted, e.bend_deg * std::numbers::pi / 180.0, e.side)
                        : ExtensionAxis(e.section, e.through);
  const double tightest = axis.tightest_bend(e.length);
  if (!(tightest >= 1.5 * e.section.radius))
    throw GeometryError("flow extensions: the axis of " + e.section.name + " bends with a radius of " +
                        std::to_string(tightest) + " mm; 1.5 times the tube's radius, " +
                        std::to_string(1.5 * e.section.radius) +
                        " mm, is the least; bend it less, or make it longer");
  return axis;
}

void build(Extension& e) {
  e.rings = extension_rings(e.section, axis_of(e), e.length, std::min(e.transition, e.length));
}

Joined joined(const geometry::TriMesh& lumen, const std::vector<std::vector<std::int32_t>>& loops,
              const std::vector<Extension>& extensions) {
  Joined out{lumen, {}};
  for (std::size_t e = 0; e < extensions.size(); ++e) {
    std::vector<std::int32_t> below(loops[e].rbegin(), loops[e].rend());  // as Section::loop has it
    const std::size_t n = below.size();
    const auto& rings = extensions[e].rings.rings;
    for (std::size_t k = 0; k < rings.size(); ++k) {
      std::vector<std::int32_t> above;
      for (const Vec3& p : rings[k]) {
        above.push_back(static_cast<std::int32_t>(out.mesh.points.size()));
        out.mesh.points.push_back(p);
      }
      // A ring turned by half a step has its point i between i and i + 1 of the one below, or the reverse.
      const bool ahead = k % 2 == 0;
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t j = (i + 1) % n;
        out.mesh.triangles.push_back({below[i], below[j], ahead ? above[i] : above[j]});
        if (ahead)
          out.mesh.triangles.push_back({below[j], above[j], above[i]});
        else
          out.mesh.triangles.push_back({below[i], above[j], above[i]});
      }
      below = std::move(above);
    }
    out.far_loops.emplace_back(below.rbegin(), below.rend());
  }
  return out;
}

}  // namespace ostia::meshing
