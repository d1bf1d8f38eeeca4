#include "dicom_series.h"

#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace ostia::imaging {
namespace {

using Key = std::optional<double> (*)(const DicomSlice&);

struct NamedKey {
  const char* name;
  const char* unit;
  Key key;
};

/// From what says "phase" to what merely differs with it.
const NamedKey kKeys[] = {
    {"cardiac phase", " %", [](const DicomSlice& s) { return s.info().cardiac_percent; }},
    {"temporal position", "", [](const DicomSlice& s) { return s.info().temporal_position; }},
    {"trigger time", " ms", [](const DicomSlice& s) { return s.info().trigger_time_ms; }},
    {"acquisition", "", [](const DicomSlice& s) { return s.header->acquisition_number; }},
    {"acquisition time", " s", [](const DicomSlice& s) { return s.header->acquisition_time; }},
    {"content time", " s", [](const DicomSlice& s) { return s.header->content_time; }},
    {"instance", "", [](const DicomSlice& s) { return s.header->instance_number; }},
};
constexpr std::size_t kOrderOnly = 6;  // instance numbers always differ: of use for their order alone

using Stack = std::vector<DicomSlice>;

/// Slices that lie on each other together; `slices` sorted by depth.
std::vector<Stack> by_place(const Stack& slices) {
  std::vector<Stack> places;
  for (const DicomSlice& slice : slices) {
    if (places.empty() || slice.depth_mm - places.back().front().depth_mm >= kSameDepthMm)
      places.emplace_back();
    places.back().push_back(slice);
  }
  return places;
}

bool has_duplicates(const Stack& slices) {
  const auto same = [](const DicomSlice& a, const DicomSlice& b) {
    return b.depth_mm - a.depth_mm < kSameDepthMm;
  };
  return std::adjacent_find(slices.begin(), slices.end(), same) != slices.end();
}

std::string label(const NamedKey& key, double value) {
  return std::string(key.name) + " " + core::significant_text(value, 6) + key.unit;
}

/// One part for each value of the key. Nothing when that leaves slices on each other, or takes apart more
/// than it must.
std::optional<DicomPhases> by_value(const Stack& slices, const NamedKey& key, std::size_t most,
                                    std::size_t places) {
  std::map<double, Stack> parts;
  for (const DicomSlice& slice : slices) {
    const auto value = key.key(slice);
    if (!value) return std::nullopt;
    parts[*value].push_back(slice);
  }
  // Phases on unequal grids give more parts than slices lie on each other, but not one part a slice.
  if (parts.size() < 2 || (places > 1 && parts.size() > 2 * most)) return std::nullopt;
  for (const auto& [value, part] : parts) {
    if (part.size() * 4 < places || (places > 1 && part.size() < 2)) return std::nullopt;
  }
  DicomPhases result;
  for (auto& [value, part] : parts) {
    if (has_duplicates(part)) return std::nullopt;
    result.labels.push_back(label(key, value));
    result.parts.push_back(std::move(part));
  }
  // A step much longer than the usual one is a phase that did not come along.
  std::vector<double> values, steps;
  for (const auto& [value, part] : parts) values.push_back(value);
  for (std::size_t i = 1; i < values.size(); ++i) steps.push_back(values[i] - values[i - 1]);
  std::vector<double> sorted = steps;
  std::sort(sorted.begin(), sorted.end());
  const double usual = sorted[sorted.size() / 2];
  for (std::size_t i = 0; i < steps.size() && steps.size() > 2; ++i) {
    if (steps[i] < 1.5 * usual) continue;
    result.warnings.push_back("a phase is missing between " + label(key, values[i]) + " and " +
                              label(key, values[i + 1]));
  }
  return result;
}

/// The first of every place is one part, the second another, by the order of the key.
std::optional<DicomPhases> by_order(const std::vector<Stack>& places, const NamedKey& key) {
  DicomPhases result;
  result.parts.resize(places.front().size());
  for (const Stack& place : places) {
    if (place.size() != result.parts.size()) return std::nullopt;
    std::map<double, const DicomSlice*> order;
    for (const DicomSlice& slice : place) {
      const auto value = key.key(slice);
      if (!value) return std::nullopt;
      order[*value] = &slice;
    }
    if (order.size() != place.size()) return std::nullopt;
    std::size_t part = 0;
    for (const auto& [value, slice] : order) result.parts[part++].push_back(*slice);
  }
  for (std::size_t i = 0; i < result.parts.size(); ++i) {
    result.labels.push_back("phase " + std::to_string(i + 1) + " of " + std::to_string(result.parts.size()));
  }
  result.warnings.push_back(std::string("slices at one place were told apart by the order of their ") +
                            key.name);
  return result;
}

/// Says where the parts do not cover the same slices.
void compare_grids(DicomPhases& phases) {
  std::size_t most = 0, least = phases.parts.front().size();
  for (const Stack& part : phases.parts) {
    most = std::max(most, part.size());
    least = std::min(least, part.size());
  }
  if (most != least) {
    phases.warnings.push_back("phases have from " + std::to_string(least) + " to " + std::to_string(most) +
                              " slices");
    return;
  }
  for (const Stack& part : phases.parts) {
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (std::abs(part[i].depth_mm - phases.parts.front()[i].depth_mm) < kSameDepthMm) continue;
      phases.warnings.push_back("phases lie on different grids");
      return;
    }
  }
}

}  // namespace

DicomPhases split_phases(std::vector<DicomSlice> slices) {
  std::stable_sort(slices.begin(), slices.end(),
                   [](const DicomSlice& a, const DicomSlice& b) { return a.depth_mm < b.depth_mm; });
  DicomPhases whole;
  if (slices.size() >= 2 && has_duplicates(slices)) {
    const std::vector<Stack> places = by_place(slices);
    std::size_t most = 0;
    for (const Stack& place : places) most = std::max(most, place.size());
    std::optional<DicomPhases> found;
    for (std::size_t k = 0; k < kOrderOnly && !found; ++k)
      found = by_value(slices, kKeys[k], most, places.size());
    // A copy of a file is no phase.
    bool copies = false;
    for (const Stack& place : places) {
      for (std::size_t i = 1; i < place.size(); ++i) {
        copies = copies || (!place[i].header->sop_instance.empty() && place[i].frame == place[i - 1].frame &&
                            place[i].header->sop_instance == place[i - 1].header->sop_instance);
      }
    }
    for (std::size_t k = 0; k <= kOrderOnly && !found && !copies; ++k) found = by_order(places, kKeys[k]);
    if (found) {
      compare_grids(*found);
      return *std::move(found);
    }
  }
  whole.parts.push_back(std::move(slices));
  whole.labels.emplace_back();
  return whole;
}

}  // namespace ostia::imaging
