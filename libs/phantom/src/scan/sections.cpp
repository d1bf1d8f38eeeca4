#include "ostia/phantom/sections.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/phantom/noise.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace ostia::phantom {
namespace {

using geometry::Health;

constexpr double end_margin_mm = 2.0;     // flat caps at the distal ends
constexpr double ostium_margin_mm = 3.0;  // the aorta's wall
constexpr double sample_mm = 0.25;        // along a vessel, when it is looked over
constexpr double section_gap_mm = 2.0;    // between a diseased section and a healthy one
constexpr double least_diseased_share = 0.5;
constexpr double lesion_share = 0.75;  // of a diseased section, for a lesion that is put there
constexpr int cases_in_suite = 18;
constexpr double suite_healthy_mm = 1880.0, suite_diseased_mm = 670.0;

/// Joins overlapping stretches and those closer than `gap`.
std::vector<Stretch> joined(std::vector<Stretch> all, double gap) {
  std::sort(all.begin(), all.end(), [](const Stretch& a, const Stretch& b) { return a.from_mm < b.from_mm; });
  std::vector<Stretch> out;
  for (const Stretch& one : all) {
    if (!out.empty() && one.from_mm <= out.back().to_mm + gap)
      out.back().to_mm = std::max(out.back().to_mm, one.to_mm);
    else
      out.push_back(one);
  }
  return out;
}

/// What is left of `whole` without `taken` (joined, ascending).
std::vector<Stretch> without(const Stretch& whole, const std::vector<Stretch>& taken) {
  std::vector<Stretch> out;
  double at = whole.from_mm;
  for (const Stretch& one : taken) {
    if (one.to_mm <= at || one.from_mm >= whole.to_mm) continue;
    if (one.from_mm > at) out.push_back({at, one.from_mm});
    at = std::max(at, one.to_mm);
  }
  if (at < whole.to_mm) out.push_back({at, whole.to_mm});
  return out;
}

std::vector<Stretch> without(const std::vector<Stretch>& whole, const std::vector<Stretch>& taken) {
  std::vector<Stretch> out;
  for (const Stretch& one : whole) {
    const std::vector<Stretch> rest = without(one, taken);
    out.insert(out.end(), rest.begin(), rest.end());
  }
  return out;
}

double overlap(const Stretch& a, const Stretch& b) {
  return std::max(0.0, std::min(a.to_mm, b.to_mm) - std::max(a.from_mm, b.from_mm));
}

/// Vessels that may meet near their origins: a child with its parent, and children of one parent.
bool related(const CoronaryVessel& a, const CoronaryVessel& b) {
  return a.parent == b.id || b.parent == a.id || (a.parent >= 0 && a.parent == b.parent);
}

/// A vessel looked at every quarter of a millimetre.
struct Sampled {
  std::vector<Vec3> points;
  std::vector<double> abscissa, wall;
};
Sampled sampled(const CoronaryVessel& vessel) {
  const geometry::Centerline& axis = vessel.axis;
  const double step = axis.abscissa.back() / static_cast<double>(axis.size() - 1);
  const auto stride = std::max<std::size_t>(1, static_cast<std::size_t>(sample_mm / step));
  Sampled out;
  for (std::size_t i = 0; i < axis.size(); i += stride) {
    out.points.push_back(axis.points[i]);
    out.abscissa.push_back(axis.abscissa[i]);
    out.wall.push_back(vessel.wall.max_at(axis.abscissa[i]));
  }
  return out;
}

/// The abscissas of `mine` at which its outer wall meets that of another vessel.
std::vector<Stretch> meeting(const Sampled& mine, const Sampled& its) {
  std::vector<Stretch> out;
  for (std::size_t i = 0; i < mine.points.size(); ++i) {
    for (std::size_t j = 0; j < its.points.size(); ++j) {
      const double apart = mine.wall[i] + its.wall[j];
      if ((mine.points[i] - its.points[j]).squaredNorm() >= apart * apart) continue;
      out.push_back({mine.abscissa[i] - sample_mm, mine.abscissa[i] + sample_mm});
      break;
    }
  }
  return joined(std::move(out), 2.0 * sample_mm);
}

/// Where the vessel with its wall and a margin is not inside the image.
std::vector<Stretch> outside(const Sampled& vessel, const imaging::Geometry& image, double margin) {
  std::vector<Stretch> out;
  for (std::size_t i = 0; i < vessel.points.size(); ++i) {
    const Vec3 index = image.index(vessel.points[i]);
    bool inside = true;
    for (int a = 0; a < 3; ++a) {
      const double need = (vessel.wall[i] + margin) / image.spacing[a];
      inside = inside && index[a] >= need &&
               index[a] <= static_cast<double>(image.size[static_cast<std::size_t>(a)] - 1) - need;
    }
    if (!inside) out.push_back({vessel.abscissa[i] - sample_mm, vessel.abscissa[i] + sample_mm});
  }
  return joined(std::move(out), 2.0 * sample_mm);
}

/// The distal part in which the vessel is too thin to be annotated, whatever lesions it bears.
std::vector<Stretch> thin(const CoronaryVessel& vessel, double least_radius) {
  const geometry::Centerline& axis = vessel.axis;
  const std::vector<double>& radius =
      vessel.healthy_radius_mm.size() == axis.size() ? vessel.healthy_radius_mm : axis.radius;
  std::size_t end = axis.size();
  while (end > 0 && radius[end - 1] < least_radius) --end;
  if (end == axis.size()) return {};
  return {{end == 0 ? 0.0 : axis.abscissa[end - 1], axis.abscissa.back() + 1.0}};
}

struct VesselRoom {
  const CoronaryVessel* vessel = nullptr;
  std::vector<Stretch> free, diseased;
};

std::vector<VesselRoom> rooms(const CoronaryTree& tree, const SectionOptions& options) {
  std::vector<VesselRoom> out;
  for (const CoronaryVessel& vessel : tree.vessels) {
    VesselRoom room;
    room.vessel = &vessel;
    room.free =
        without(free_stretches(tree, vessel.id, options.image), thin(vessel, options.least_radius_mm));
    room.diseased = diseased_stretches(vessel);
    out.push_back(std::move(room));
  }
  return out;
}

/// A window over disease on one vessel.
struct SectionWindow {
  std::size_t room = 0;
  Stretch stretch;
  double diseased_mm = 0.0;
};

double diseased_length(const VesselRoom& room, const Stretch& window) {
  double sum = 0.0;
  for (const Stretch& one : room.diseased) sum += overlap(one, window);
  return sum;
}

/// Stretches of healthy lumen, the longest first.
std::vector<SectionWindow> healthy_room(const std::vector<VesselRoom>& all,
                                        const std::vector<SectionWindow>& diseased, double least) {
  std::vector<SectionWindow> out;
  for (std::size_t r = 0; r < all.size(); ++r) {
    std::vector<Stretch> taken = all[r].diseased;
    for (const SectionWindow& one : diseased) {
      if (one.room == r)
        taken.push_back({one.stretch.from_mm - section_gap_mm, one.stretch.to_mm + section_gap_mm});
    }
    for (const Stretch& one : without(all[r].free, joined(taken, 0.0)))
      if (one.length_mm() >= least) out.push_back({r, one, 0.0});
  }
  std::stable_sort(out.begin(), out.end(), [](const SectionWindow& a, const SectionWindow& b) {
    return a.stretch.length_mm() > b.stretch.length_mm();
  });
  return out;
}

/// How much healthy lumen the longest stretches hold that are left beside these windows.
double healthy_capacity(const std::vector<VesselRoom>& all, const std::vector<SectionWindow>& diseased,
                        const SectionOptions& options) {
  double sum = 0.0;
  const std::vector<SectionWindow> room = healthy_room(all, diseased, options.least_length_mm);
  for (std::size_t i = 0; i < room.size() && i < static_cast<std::size_t>(options.quota.healthy); ++i)
    sum += room[i].stretch.length_mm();
  return std::min(sum, options.quota.healthy_mm);
}

/// Windows of `size` within a free stretch over a lesion: about its middle, from its beginning, to its end.
std::vector<Stretch> windows_over(const Stretch& lesion, const Stretch& free, double size) {
  constexpr double margin_mm = 1.0;
  std::vector<Stretch> out;
  for (const double from : {0.5 * (lesion.from_mm + lesion.to_mm - size), lesion.from_mm - margin_mm,
                            lesion.to_mm + margin_mm - size}) {
    const double at = std::clamp(from, free.from_mm, free.to_mm - size);
    out.push_back({at, at + size});
  }
  return out;
}

/// The window of `length` (or as long as the room is) that leaves the healthy sections their room and holds
/// most disease.
std::optional<SectionWindow> best_window(const std::vector<VesselRoom>& all, double length,
                                         const SectionOptions& options, std::vector<SectionWindow> chosen) {
  constexpr double weight_of_healthy = 3.0;
  std::optional<SectionWindow> best;
  double best_score = 0.0;
  for (std::size_t r = 0; r < all.size(); ++r) {
    std::vector<Stretch> taken;
    for (const SectionWindow& one : chosen) {
      if (one.room == r)
        taken.push_back({one.stretch.from_mm - section_gap_mm, one.stretch.to_mm + section_gap_mm});
    }
    for (const Stretch& free : without(all[r].free, joined(taken, 0.0))) {
      const double size = std::min(length, free.length_mm());
      if (size < options.least_length_mm) continue;
      for (const Stretch& lesion : all[r].diseased) {
        for (const Stretch& window : windows_over(lesion, free, size)) {
          const double diseased = diseased_length(all[r], window);
          const double share = diseased / length;  // of what was asked for: a full window beats a short one
          if (share <= least_diseased_share || diseased < least_diseased_share * size) continue;
          chosen.push_back({r, window, diseased});
          const double healthy =
              healthy_capacity(all, chosen, options) / std::max(1e-9, options.quota.healthy_mm);
          chosen.pop_back();
          const double score = weight_of_healthy * std::min(1.0, healthy) + share;
          if (score > best_score) {
            best = SectionWindow{r, window, diseased};
            best_score = score;
          }
        }
      }
    }
  }
  return best;
}

std::vector<SectionWindow> diseased_windows(const std::vector<VesselRoom>& all,
                                            const SectionOptions& options) {
  std::vector<SectionWindow> chosen;
  double left = options.quota.diseased_mm;
  for (int i = 0; i < options.quota.diseased; ++i) {
    const double length = left / (options.quota.diseased - i);
    const auto window = best_window(all, length, options, chosen);
    if (!window) break;
    left -= window->stretch.length_mm();
    chosen.push_back(*window);
  }
  return chosen;
}

/// Shares `total` among rooms of these sizes as evenly as they allow.
std::vector<double> shared_out(const std::vector<SectionWindow>& room, double total) {
  std::vector<double> out(room.size(), 0.0);
  std::vector<std::size_t> order(room.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return room[a].stretch.length_mm() < room[b].stretch.length_mm();
  });
  double left = total;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double even = left / static_cast<double>(order.size() - i);
    out[order[i]] = std::min(even, room[order[i]].stretch.length_mm());
    left -= out[order[i]];
  }
  return out;
}

/// Cuts the longest stretches in two until there are `count`, or none is long enough.
void split_to(std::vector<SectionWindow>& room, std::size_t count, double least) {
  while (room.size() < count) {
    const auto longest =
        std::max_element(room.begin(), room.end(), [](const SectionWindow& a, const SectionWindow& b) {
          return a.stretch.length_mm() < b.stretch.length_mm();
        });
    if (longest == room.end() || longest->stretch.length_mm() < 2.0 * least + section_gap_mm) return;
    SectionWindow second = *longest;
    const double middle = 0.5 * (longest->stretch.from_mm + longest->stretch.to_mm);
    longest->stretch.to_mm = middle - 0.5 * section_gap_mm;
    second.stretch.from_mm = middle + 0.5 * section_gap_mm;
    room.push_back(second);
  }
}

std::vector<SectionWindow> healthy_windows(const std::vector<VesselRoom>& all,
                                           const std::vector<SectionWindow>& diseased,
                                           const SectionOptions& options) {
  std::vector<SectionWindow> room = healthy_room(all, diseased, options.least_length_mm);
  const auto count = static_cast<std::size_t>(options.quota.healthy);
  if (room.size() > count) room.resize(count);
  split_to(room, count, options.least_length_mm);
  const std::vector<double> lengths = shared_out(room, options.quota.healthy_mm);
  for (std::size_t i = 0; i < room.size(); ++i) {
    const double spare = room[i].stretch.length_mm() - lengths[i];
    room[i].stretch.from_mm += spare * uniform(options.seed, 7100 + i);
    room[i].stretch.to_mm = room[i].stretch.from_mm + lengths[i];
  }
  return room;
}

void add(std::vector<AnnotatedSection>& out, const std::vector<VesselRoom>& all,
         const std::vector<SectionWindow>& windows, Health health) {
  for (const SectionWindow& one : windows) {
    AnnotatedSection section;
    section.vessel = all[one.room].vessel->id;
    section.s_from_mm = one.stretch.from_mm;
    section.s_to_mm = one.stretch.to_mm;
    section.health = health;
    out.push_back(std::move(section));
  }
}

void warn_of_missing(const std::vector<AnnotatedSection>& sections, Health health, int count, double length,
                     std::vector<std::string>& warnings) {
  int found = 0;
  double sum = 0.0;
  for (const AnnotatedSection& one : sections) {
    if (one.health != health) continue;
    ++found;
    sum += one.length_mm();
  }
  if (found == count && sum > length - 0.05) return;
  warnings.push_back(std::string(health == Health::healthy ? "healthy" : "diseased") +
                     " sections: " + std::to_string(found) + " of " + core::fixed_text(sum, 1) +
                     " mm in all instead of " + std::to_string(count) + " of " + core::fixed_text(length, 1) +
                     " mm; the tree has no more within the image that is clear of bifurcations");
}

}  // namespace

const CoronaryVessel& vessel_of(const CoronaryTree& tree, std::int32_t id) {
  for (const CoronaryVessel& vessel : tree.vessels)
    if (vessel.id == id) return vessel;
  throw InvalidInput("the coronary tree has no vessel " + std::to_string(id) +
                     "; ids are those of `vessels`");
}

void validate(const SectionOptions& options) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw InvalidInput(std::string("annotated sections: ") + what);
  };
  require(options.quota.healthy >= 0 && options.quota.diseased >= 0, "a number of sections is negative");
  require(options.quota.healthy_mm >= 0.0 && options.quota.diseased_mm >= 0.0 &&
              std::isfinite(options.quota.healthy_mm + options.quota.diseased_mm),
          "a length is negative or not finite (mm)");
  require(options.least_length_mm > 0.0 && std::isfinite(options.least_length_mm),
          "the least length must be above 0 mm");
  require(options.least_radius_mm >= 0.0, "the least radius must not be negative (mm)");
}

std::vector<Stretch> diseased_stretches(const CoronaryVessel& vessel) {
  std::vector<Stretch> out;
  for (const Stenosis& one : vessel.stenoses) out.push_back({one.s_from_mm, one.s_to_mm});
  for (const Plaque& one : vessel.plaques)
    out.push_back({one.s_centre_mm - 0.5 * one.length_mm, one.s_centre_mm + 0.5 * one.length_mm});
  return joined(std::move(out), 1.0);
}

double disease_at(const CoronaryVessel& vessel, double s_mm) {
  constexpr double ramp_mm = 2.0;
  double most = 0.0;
  const auto look = [&](double from, double to) {
    const double beside = std::max({from - s_mm, s_mm - to, 0.0}) / ramp_mm;
    if (beside < 1.0) most = std::max(most, 1.0 - beside * beside * (3.0 - 2.0 * beside));
  };
  for (const Stenosis& one : vessel.stenoses) look(one.s_from_mm, one.s_to_mm);
  for (const Plaque& one : vessel.plaques)
    look(one.s_centre_mm - 0.5 * one.length_mm, one.s_centre_mm + 0.5 * one.length_mm);
  return most;
}

std::vector<Stretch> free_stretches(const CoronaryTree& tree, std::int32_t id,
                                    const std::optional<imaging::Geometry>& image, double margin_mm) {
  const CoronaryVessel& vessel = vessel_of(tree, id);
  if (vessel.axis.size() < 2) return {};
  const Stretch whole{vessel.parent < 0 ? ostium_margin_mm : vessel.s_free_mm,
                      vessel.axis.abscissa.back() - end_margin_mm};
  if (whole.length_mm() <= 0.0) return {};
  const Sampled mine = sampled(vessel);
  std::vector<Stretch> taken;
  for (const CoronaryVessel& other : tree.vessels) {
    if (other.id == id || other.axis.size() < 2 || !related(vessel, other)) continue;
    for (const Stretch& one : meeting(mine, sampled(other))) taken.push_back(one);
  }
  if (image) {
    for (const Stretch& one : outside(mine, *image, margin_mm)) taken.push_back(one);
  }
  return without(whole, joined(std::move(taken), 0.0));
}

SectionQuota section_quota(std::uint64_t seed) {
  // Every third case has a second diseased section: 12 x 4 + 6 x 5 = 78.
  constexpr double one_diseased_mm = 28.0;
  SectionQuota quota;
  quota.healthy_mm = suite_healthy_mm / cases_in_suite;
  quota.diseased = seed % 3 == 0 ? 2 : 1;
  quota.diseased_mm =
      quota.diseased == 2 ? (suite_diseased_mm - 12.0 * one_diseased_mm) / 6.0 : one_diseased_mm;
  return quota;
}

SectionPlan plan_sections(const CoronaryTree& tree, const SectionOptions& options) {
  validate(options);
  const std::vector<VesselRoom> all = rooms(tree, options);
  const std::vector<SectionWindow> diseased = diseased_windows(all, options);
  SectionPlan plan;
  add(plan.sections, all, diseased, Health::diseased);
  add(plan.sections, all, healthy_windows(all, diseased, options), Health::healthy);
  std::stable_sort(plan.sections.begin(), plan.sections.end(),
                   [](const AnnotatedSection& a, const AnnotatedSection& b) {
                     return std::pair(a.vessel, a.s_from_mm) < std::pair(b.vessel, b.s_from_mm);
                   });
  for (std::size_t i = 0; i < plan.sections.size(); ++i) {
    plan.sections[i].key = (i < 9 ? "s0" : "s") + std::to_string(i + 1);
  }
  warn_of_missing(plan.sections, Health::healthy, options.quota.healthy, options.quota.healthy_mm,
                  plan.warnings);
  warn_of_missing(plan.sections, Health::diseased, options.quota.diseased, options.quota.diseased_mm,
                  plan.warnings);
  return plan;
}

std::vector<LesionSite> missing_lesions(const CoronaryTree& tree, const SectionOptions& options) {
  validate(options);
  std::vector<VesselRoom> all = rooms(tree, options);
  std::vector<LesionSite> sites;
  const int wanted = options.quota.diseased;
  while (static_cast<int>(sites.size()) < wanted) {
    const std::vector<SectionWindow> found = diseased_windows(all, options);
    double length_found = 0.0;
    for (const SectionWindow& one : found) length_found += one.stretch.length_mm();
    if (static_cast<int>(found.size()) == wanted && length_found > options.quota.diseased_mm - 0.05) break;
    // The stretch of healthy lumen on which a section fits with least healthy lumen lost: the shortest that
    // is long enough, else the longest.
    const double length = options.quota.diseased_mm / std::max(1, wanted);
    const std::vector<SectionWindow> room = healthy_room(all, found, options.least_length_mm);
    if (room.empty()) break;
    const SectionWindow* best = &room.front();
    for (const SectionWindow& one : room)
      if (one.stretch.length_mm() >= length + 2.0) best = &one;
    const double size = std::min(length, best->stretch.length_mm());
    const double spare = best->stretch.length_mm() - size;
    // At one of its ends, so that what is left stays whole.
    const double centre =
        best->stretch.from_mm + 0.5 * size + (uniform(options.seed, 7200 + sites.size()) < 0.5 ? 0.0 : spare);
    sites.push_back({all[best->room].vessel->id, centre, lesion_share * size});
    all[best->room].diseased.push_back(
        {centre - 0.5 * lesion_share * size, centre + 0.5 * lesion_share * size});
    all[best->room].diseased = joined(all[best->room].diseased, 1.0);
  }
  return sites;
}

}  // namespace ostia::phantom
