#include "ostia/lumen/lumen_model.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/geometry/spline.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace ostia::lumen {
namespace {

constexpr double unit_tolerance = 1e-6;
// An axis rebuilt from its tree is the same to the last bit; one of another tree differs by far more.
constexpr double axis_tolerance_mm = 1e-6;

[[noreturn]] void refuse_unknown(const geometry::VesselTree& tree, std::int32_t id) {
  std::string known;
  for (const geometry::Vessel& v : tree.vessels)
    known += (known.empty() ? "" : ", ") + std::to_string(v.id) + (v.name.empty() ? "" : " (" + v.name + ")");
  throw InvalidInput("the model has no vessel " + std::to_string(id) +
                     (known.empty() ? "" : "; it has " + known));
}

const geometry::Vessel& tree_vessel(const geometry::VesselTree& tree, std::int32_t id) {
  for (const geometry::Vessel& v : tree.vessels) {
    if (v.id == id) return v;
  }
  refuse_unknown(tree, id);
}

std::int32_t owning_vessel(const geometry::VesselTree& tree, std::int32_t segment) {
  for (const geometry::Vessel& v : tree.vessels) {
    if (std::find(v.segments.begin(), v.segments.end(), segment) != v.segments.end()) return v.id;
  }
  throw InvalidInput("segment " + std::to_string(segment) + " belongs to no vessel of the model");
}

/// Arc length of the first `count` segments of a vessel, as its smooth axis has it.
double way(const geometry::VesselTree& tree, const geometry::Vessel& vessel, std::size_t count) {
  if (count == 0) return 0.0;
  geometry::Vessel part = vessel;
  part.segments.resize(count);
  return geometry::ArcLengthSpline(geometry::vessel_axis(tree, part).points).length();
}

std::string name_of(const geometry::Vessel& vessel) {
  return "vessel " + std::to_string(vessel.id) + " (" + vessel.name + ")";
}

std::optional<std::string> axis_fault(const LumenModel& model, const geometry::Vessel& vessel,
                                      const VesselLumen& lumen) {
  if (!lumen.axis) return name_of(vessel) + " has no axis";
  const geometry::Centerline line = geometry::vessel_axis(model.tree, vessel);
  const double length = geometry::ArcLengthSpline(line.points).length();
  const auto differs = [&](const Vec3& a, const Vec3& b) { return !((a - b).norm() <= axis_tolerance_mm); };
  if (!(std::abs(length - lumen.axis->length()) <= axis_tolerance_mm) ||
      differs(lumen.axis->point(0.0), line.points.front()) ||
      differs(lumen.axis->point(lumen.axis->length()), line.points.back()))
    return name_of(vessel) + " has an axis that is not its tree's";
  if (!(std::abs(own_from_mm(model.tree, vessel.id) - lumen.own_from_mm) <= axis_tolerance_mm))
    return name_of(vessel) + " begins at " + std::to_string(lumen.own_from_mm) +
           " mm, where its tree has another vessel";
  return std::nullopt;
}

std::optional<std::string> sample_fault(const SurfaceSample& sample, const std::string& owner) {
  const std::string name = "sample " + std::to_string(sample.id) + " of " + owner;
  if (!sample.position.allFinite() || !std::isfinite(sample.s_mm) || !sample.normal.allFinite())
    return name + " is not finite";
  if (!(std::abs(sample.normal.norm() - 1.0) <= unit_tolerance))
    return name + " has a normal that is not of unit length";
  return std::nullopt;
}

std::optional<std::string> lumen_fault(const LumenModel& model, const geometry::Vessel& vessel,
                                       const VesselLumen& lumen, std::unordered_set<std::int64_t>& ids) {
  const std::string name = name_of(vessel);
  if (lumen.vessel != vessel.id)
    return "the wall of vessel " + std::to_string(lumen.vessel) + " stands in the place of " + name;
  if (auto fault = axis_fault(model, vessel, lumen)) return fault;
  if (lumen.samples.empty()) return name + " has no samples of its wall";
  for (std::size_t i = 0; i < lumen.samples.size(); ++i) {
    const SurfaceSample& sample = lumen.samples[i];
    if (auto fault = sample_fault(sample, name)) return fault;
    if (!ids.insert(sample.id).second) return "two samples have the id " + std::to_string(sample.id);
    if (sample.id >= model.next_sample_id)
      return "sample " + std::to_string(sample.id) + " of " + name + " is not below the next id, " +
             std::to_string(model.next_sample_id);
    if (i > 0 && !canonical_order(lumen.samples[i - 1], sample))
      return "sample " + std::to_string(sample.id) + " of " + name + " is out of order";
  }
  return std::nullopt;
}

std::optional<std::string> tree_id_fault(const LumenModel& model) {
  const auto beyond = [&](const char* what, std::int32_t id) -> std::optional<std::string> {
    if (id < model.next_tree_id) return std::nullopt;
    return std::string(what) + " " + std::to_string(id) + " is not below the next id, " +
           std::to_string(model.next_tree_id);
  };
  for (const auto& n : model.tree.nodes) {
    if (auto fault = beyond("node", n.id)) return fault;
  }
  for (const auto& s : model.tree.segments) {
    if (auto fault = beyond("segment", s.id)) return fault;
  }
  for (const auto& v : model.tree.vessels) {
    if (auto fault = beyond("vessel", v.id)) return fault;
  }
  return std::nullopt;
}

/// Everything stored, in order, as bytes. Counts go before lists, so that no two models read alike.
class Bytes {
 public:
  void add(std::int64_t value) { raw(&value, sizeof value); }
  void add(double value) { raw(&value, sizeof value); }
  void add(const Vec3& v) {
    for (int k = 0; k < 3; ++k) add(v[k]);
  }
  void add(const std::string& text) {
    count(text.size());
    bytes_ += text;
  }
  void add(const std::vector<double>& values) {
    count(values.size());
    for (const double value : values) add(value);
  }
  void count(std::size_t n) { add(static_cast<std::int64_t>(n)); }
  void add(const geometry::Centerline& line) {
    count(line.points.size());
    for (const Vec3& point : line.points) add(point);
    add(line.radius);
    add(line.abscissa);
    count(line.frames.size());
    for (const geometry::Frame& frame : line.frames) {
      add(frame.tangent);
      add(frame.normal);
      add(frame.binormal);
    }
  }
  void add(const geometry::VesselTree& tree) {
    count(tree.nodes.size());
    for (const auto& n : tree.nodes) {
      add(std::int64_t{n.id});
      add(n.position);
    }
    count(tree.segments.size());
    for (const auto& s : tree.segments) {
      for (const std::int32_t id : {s.id, s.from, s.to}) add(std::int64_t{id});
      add(s.axis);
    }
    count(tree.vessels.size());
    for (const auto& v : tree.vessels) {
      add(std::int64_t{v.id});
      add(v.name);
      count(v.segments.size());
      for (const std::int32_t id : v.segments) add(std::int64_t{id});
    }
  }
  void add(const VesselLumen& lumen) {
    add(std::int64_t{lumen.vessel});
    add(lumen.own_from_mm);
    add(static_cast<std::int64_t>(lumen.interpolation.kernel));
    add(lumen.interpolation.support_radius_mm);
    add(lumen.interpolation.offset_mm);
    add(static_cast<std::int64_t>(lumen.interpolation.far_field));
    count(lumen.samples.size());
    for (const SurfaceSample& sample : lumen.samples) {
      add(sample.id);
      add(sample.position);
      add(sample.normal);
      add(sample.s_mm);
      add(static_cast<std::int64_t>(sample.origin));
    }
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void raw(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }
  std::string bytes_;
};

}  // namespace

const VesselLumen& vessel(const LumenModel& model, std::int32_t id) {
  for (const auto& lumen : model.vessels) {
    if (lumen->vessel == id) return *lumen;
  }
  refuse_unknown(model.tree, id);
}

double own_from_mm(const geometry::VesselTree& tree, std::int32_t vessel) {
  const geometry::Vessel& path = tree_vessel(tree, vessel);
  std::size_t shared = 0;
  while (shared < path.segments.size() && owning_vessel(tree, path.segments[shared]) != vessel) ++shared;
  return way(tree, path, shared);
}

std::int32_t owner_at(const geometry::VesselTree& tree, std::int32_t vessel, double s_mm) {
  const geometry::Vessel& path = tree_vessel(tree, vessel);
  std::int32_t owner = vessel;
  for (std::size_t i = path.segments.size(); i-- > 0;) {
    owner = owning_vessel(tree, path.segments[i]);
    if (s_mm >= way(tree, path, i)) break;
  }
  return owner;
}

std::optional<std::string> find_fault(const LumenModel& model) {
  if (auto fault = geometry::find_fault(model.tree)) return fault;
  if (auto fault = tree_id_fault(model)) return fault;
  if (model.vessels.size() != model.tree.vessels.size())
    return "the model has walls of " + std::to_string(model.vessels.size()) + " vessels and its tree has " +
           std::to_string(model.tree.vessels.size());
  std::unordered_set<std::int64_t> ids;
  for (std::size_t i = 0; i < model.vessels.size(); ++i) {
    const geometry::Vessel& path = model.tree.vessels[i];
    if (!model.vessels[i]) return name_of(path) + " has no wall";
    if (auto fault = lumen_fault(model, path, *model.vessels[i], ids)) return fault;
  }
  return std::nullopt;
}

std::string digest(const LumenModel& model) {
  Bytes bytes;
  bytes.add(model.tree);
  bytes.count(model.vessels.size());
  for (const auto& lumen : model.vessels) bytes.add(*lumen);
  bytes.add(model.blend.width_mm);
  bytes.add(static_cast<std::int64_t>(model.blend.joints));
  bytes.add(model.next_sample_id);
  bytes.add(std::int64_t{model.next_tree_id});
  return core::sha256(bytes.bytes());
}

}  // namespace ostia::lumen
