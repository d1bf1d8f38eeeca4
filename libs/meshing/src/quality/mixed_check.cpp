#include "boundary_layer/wall.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/meshing/mixed_quality.h"

namespace ostia::meshing {

using geometry::Vec3;

namespace {

/// Collects what is wrong.
class Reasons {
 public:
  explicit Reasons(QualityVerdict& verdict) : verdict_(verdict) {}
  void none(std::size_t count, const std::string& what) {
    if (count > 0) verdict_.reasons.push_back(std::to_string(count) + " " + what);
  }
  void at_least(double value, double bound, const std::string& what, const std::string& unit,
                const Vec3* at) {
    if (!(value >= bound)) add(what, value, unit, "below", bound, at);
  }
  void at_most(double value, double bound, const std::string& what, const std::string& unit, const Vec3* at) {
    if (!(value <= bound)) add(what, value, unit, "above", bound, at);
  }

 private:
  void add(const std::string& what, double value, const std::string& unit, const char* side, double bound,
           const Vec3* at) {
    verdict_.reasons.push_back(what + " " + core::significant_text(value, 4) + unit + " is " + side + " " +
                               core::significant_text(bound, 4) + (at ? ", near " + place_text(*at) : ""));
  }
  QualityVerdict& verdict_;
};

/// The tetrahedra of the layers, and those that are none.
void check_layers(const LayerTetrahedra& q, const MixedBounds& bounds, Reasons& reasons) {
  reasons.at_most(q.max_dihedral_deg, bounds.max_layer_dihedral_deg,
                  "largest dihedral angle of the layers' tetrahedra", " degrees", &q.bluntest_at);
  reasons.at_least(q.others_min_dihedral_deg, bounds.min_dihedral_deg,
                   "smallest dihedral angle of the tetrahedra inside the layers", " degrees",
                   &q.others_sharpest_at);
  reasons.at_least(q.others_min_scaled_jacobian, bounds.min_tetrahedron_scaled_jacobian,
                   "smallest scaled Jacobian of the tetrahedra inside the layers", "", &q.others_worst_at);
  reasons.at_most(q.others_max_non_orthogonality_deg, bounds.max_non_orthogonality_deg,
                  "largest non-orthogonality inside the layers", " degrees", &q.others_least_orthogonal_at);
}

void check_elements(const MixedQuality& q, const MixedBounds& bounds, Reasons& reasons) {
  const auto where = [](const ElementQuality& e) { return ", the worst near " + place_text(e.worst_at); };
  reasons.none(q.tetrahedra.inverted, "inverted tetrahedra" + where(q.tetrahedra));
  reasons.none(q.prisms.inverted, "inverted prisms" + where(q.prisms));
  if (q.layers) {
    check_layers(*q.layers, bounds, reasons);
  } else if (q.tetrahedra.count > 0) {
    reasons.at_least(q.tetrahedra.min_dihedral_deg, bounds.min_dihedral_deg,
                     "smallest dihedral angle of the tetrahedra", " degrees", &q.tetrahedra.sharpest_at);
    reasons.at_least(q.tetrahedra.min_scaled_jacobian, bounds.min_tetrahedron_scaled_jacobian,
                     "smallest scaled Jacobian of the tetrahedra", "", &q.tetrahedra.worst_at);
  }
  if (q.prisms.count > 0)
    reasons.at_least(q.prisms.min_scaled_jacobian, bounds.min_prism_scaled_jacobian,
                     "smallest scaled Jacobian of the prisms", "", &q.prisms.worst_at);
}

}  // namespace

void validate(const MixedBounds& b) {
  const auto refuse = [](const std::string& what) { throw InvalidInput("quality bounds: " + what); };
  if (!(b.min_dihedral_deg >= 0.0 && b.min_dihedral_deg < 70.0))
    refuse("min_dihedral_deg must lie in [0, 70) degrees");
  for (const double bound : {b.min_tetrahedron_scaled_jacobian, b.min_prism_scaled_jacobian})
    if (!(bound > -1.0 && bound < 1.0)) refuse("a bound of the scaled Jacobian must lie in (-1, 1)");
  if (!(b.max_non_orthogonality_deg > 0.0 && b.max_non_orthogonality_deg <= 90.0))
    refuse("max_non_orthogonality_deg must lie in (0, 90] degrees");
  if (!(b.max_layer_non_orthogonality_deg > 0.0 && b.max_layer_non_orthogonality_deg <= 90.0))
    refuse("max_layer_non_orthogonality_deg must lie in (0, 90] degrees");
  if (!(b.max_layer_dihedral_deg > 90.0 && b.max_layer_dihedral_deg < 180.0))
    refuse("max_layer_dihedral_deg must lie in (90, 180) degrees");
  if (!(b.max_skewness > 0.0)) refuse("max_skewness must be above 0");
  if (!(b.max_aspect_ratio >= 1.0)) refuse("max_aspect_ratio must be at least 1");
  if (!(b.min_volume_ratio >= 0.0 && b.min_volume_ratio < 1.0)) refuse("min_volume_ratio must lie in [0, 1)");
}

QualityVerdict check(const MixedQuality& q, const MixedBounds& bounds) {
  validate(bounds);
  QualityVerdict verdict;
  Reasons reasons(verdict);
  if (q.tetrahedra.count + q.prisms.count == 0) {
    verdict.reasons.push_back("no elements");
    return verdict;
  }
  check_elements(q, bounds, reasons);
  reasons.none(q.boundary_mismatches, "sides where the boundary and the elements do not match, one near " +
                                          place_text(q.mismatch_at));
  reasons.none(q.unnamed_facets, "facets of the boundary whose id no face has");
  for (const FaceQuality& face : q.faces)
    if (face.triangles + face.quads == 0) verdict.reasons.push_back("face " + face.name + " has no facet");
  const OpenFoamQuality& foam = q.openfoam;
  reasons.at_most(foam.max_non_orthogonality_deg,
                  q.layers ? bounds.max_layer_non_orthogonality_deg : bounds.max_non_orthogonality_deg,
                  "largest non-orthogonality", " degrees", &foam.least_orthogonal_at);
  reasons.at_most(foam.max_skewness, bounds.max_skewness, "largest skewness", "", &foam.most_skewed_at);
  reasons.at_most(foam.max_aspect_ratio, bounds.max_aspect_ratio, "largest aspect ratio", "", nullptr);
  reasons.at_least(foam.min_volume_ratio, bounds.min_volume_ratio,
                   "smallest ratio of the volumes of neighbouring cells", "", nullptr);
  return verdict;
}

}  // namespace ostia::meshing
