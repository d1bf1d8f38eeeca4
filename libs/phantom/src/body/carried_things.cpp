#include "body/body_organs.h"

#include "ostia/phantom/carried.h"
#include "ostia/phantom/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace ostia::phantom {
namespace {

constexpr std::uint64_t carried_stream = 0x6361727279ULL;
// Effective CT numbers: metal is far beyond the scale, and beams harden in it.
constexpr float steel_hu = 9000.0f, titanium_hu = 7000.0f, copper_hu = 4000.0f, coil_hu = 8000.0f;

class Drawer {
 public:
  Drawer(std::uint64_t seed, std::uint64_t stream) : seed_(seed ^ carried_stream), index_(stream << 16) {}
  double between(double low, double high) { return low + (high - low) * uniform(seed_, index_++); }
  Vec3 direction() {
    const double z = between(-1.0, 1.0), a = between(0.0, 2.0 * std::numbers::pi);
    const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
    return {r * std::cos(a), r * std::sin(a), z};
  }

 private:
  std::uint64_t seed_, index_;
};

Vec3 in_world(const CarryingPatient& patient, const Vec3& own) {
  return patient.warp == nullptr ? own : patient.warp->to_world(own);
}

std::vector<MetalPiece> pieces_of(const CarryingPatient& patient, const Capsules& capsules) {
  std::vector<MetalPiece> out;
  for (const Capsule& c : capsules)
    out.push_back({in_world(patient, c.from), in_world(patient, c.to), c.from_radius, c.to_radius});
  return out;
}

/// Evenly over the sternum's height beside the heart, none quite where it should be.
CarriedThing wire(const CarryingPatient& patient, int n, int of, Drawer& draw) {
  constexpr double lowest = -68.0, highest = 78.0;
  const double step = (highest - lowest) / of;
  const double height = lowest + step * (n + 0.5) + draw.between(-0.12, 0.12) * step;
  return {ThingKind::sternal_wire, steel_hu, pieces_of(patient, sternal_wire(height))};
}

const CoronaryVessel* graft_of(const CoronaryTree& tree) {
  for (const CoronaryVessel& vessel : tree.vessels)
    if (vessel.name == "SVG") return &vessel;
  return nullptr;
}

/// Two legs of 5 mm that meet at one end.
CarriedThing clip(const CarryingPatient& patient, int n, int of, Drawer& draw) {
  constexpr double length = 5.0, opening = 0.5, radius = 0.4, clear = 1.6;
  Vec3 place;
  if (const CoronaryVessel* graft = graft_of(patient.tree)) {
    const auto last = static_cast<double>(graft->axis.size() - 1);
    const auto i = static_cast<std::size_t>(last * (n + draw.between(0.2, 0.8)) / of);
    const double angle = draw.between(0.0, 2.0 * std::numbers::pi);
    const geometry::Frame& frame = graft->axis.frames[i];
    const Vec3 aside = std::cos(angle) * frame.normal + std::sin(angle) * frame.binormal;
    place = graft->axis.points[i] + (graft->wall.max_at(graft->axis.abscissa[i]) + clear) * aside;
  } else {
    const double step = 120.0 / of;
    const Vec3 bed = mammary_bed(-40.0 + step * (n + draw.between(0.1, 0.9)));
    place = in_world(patient, bed + 2.0 * draw.direction());
  }
  const Vec3 along = draw.direction();
  Vec3 across = draw.direction();
  across = (across - along * along.dot(across)).normalized();
  const Vec3 bend = place - 0.5 * length * along;
  return {ThingKind::clip,
          titanium_hu,
          {{bend, bend + length * along + opening * across, radius, radius},
           {bend, bend + length * along - opening * across, radius, radius}}};
}

/// Where the skin is met from the front, at a place of the body's own.
std::optional<Vec3> skin_at(const CarryingPatient& patient, double x, double z) {
  constexpr double front = -230.0, back = 60.0, step = 0.5;
  const auto part = patient.body.part({Vec3(x, front, z), Vec3(x, back, z)});
  for (double y = front; y < back; y += step)
    if (part->at({x, y, z}).label != Label::outside_air) return Vec3(x, y, z);
  return std::nullopt;
}

/// A stud on the skin and a wire that runs up from it, now on the skin, now over it.
std::optional<CarriedThing> ecg_lead(const CarryingPatient& patient, int n, Drawer& draw) {
  constexpr std::array<std::array<double, 2>, 6> usual{
      {{50, 62}, {-66, 62}, {62, -58}, {-74, -58}, {-8, 26}, {30, 8}}};
  const auto& [x, z] = usual[static_cast<std::size_t>(n) % usual.size()];
  const double at_x = x + draw.between(-8.0, 8.0), at_z = z + draw.between(-8.0, 8.0);
  const std::optional<Vec3> spot = skin_at(patient, at_x, at_z);
  if (!spot) return std::nullopt;
  CarriedThing lead{ThingKind::ecg_lead, copper_hu, {}};
  constexpr double stud = 1.8, wire_radius = 0.45, reach = 130.0, step = 8.0;
  const Vec3 top = *spot + Vec3(0, -2.5, 0);
  lead.pieces.push_back({*spot + Vec3(0, -0.8, 0), top, stud, stud});
  Vec3 last = top;
  const double drift = draw.between(-0.35, 0.35);
  for (double up = step; up <= reach; up += step) {
    const std::optional<Vec3> below = skin_at(patient, at_x + drift * up, at_z + up);
    if (!below) break;
    const Vec3 next = *below + Vec3(0, -draw.between(1.0, 4.0), 0);
    lead.pieces.push_back({last, next, wire_radius, wire_radius});
    last = next;
  }
  return lead;
}

}  // namespace

const char* word(ThingKind kind) {
  switch (kind) {
    case ThingKind::sternal_wire:
      return "sternal wire";
    case ThingKind::clip:
      return "clip";
    case ThingKind::ecg_lead:
      return "ECG lead";
    case ThingKind::pacemaker_lead:
      break;
  }
  return "pacemaker lead";
}

std::vector<CarriedThing> carried_things(const CarryingPatient& patient, const ScanRealism& realism,
                                         std::uint64_t seed) {
  validate(realism);
  std::vector<CarriedThing> out;
  for (int n = 0; n < realism.sternal_wires; ++n) {
    Drawer draw(seed, 100 + static_cast<std::uint64_t>(n));
    out.push_back(wire(patient, n, realism.sternal_wires, draw));
  }
  for (int n = 0; n < realism.clips; ++n) {
    Drawer draw(seed, 200 + static_cast<std::uint64_t>(n));
    out.push_back(clip(patient, n, realism.clips, draw));
  }
  for (int n = 0; n < realism.ecg_leads; ++n) {
    Drawer draw(seed, 300 + static_cast<std::uint64_t>(n));
    if (std::optional<CarriedThing> lead = ecg_lead(patient, n, draw)) out.push_back(*std::move(lead));
  }
  for (int n = 0; n < realism.pacemaker_leads; ++n)
    out.push_back({ThingKind::pacemaker_lead, coil_hu, pieces_of(patient, pacing_lead(patient.heart, n))});
  return out;
}

}  // namespace ostia::phantom
