#include "ostia/view/volume_look.h"

#include "ostia/core/error.h"

#include <cmath>
#include <string>

namespace ostia::view {
namespace {

struct PresetTable {
  double middle_hu;
  VolumeTransfer transfer;
};

/// Fat is at -80 HU, muscle at 60 to 130, contrast at 250 to 600, calcium from 650 on.
const PresetTable& table_of(VolumePreset preset) {
  static const PresetTable coronary{220.0,
                                    {{{-20.0, {0.30, 0.07, 0.05}},
                                      {70.0, {0.46, 0.13, 0.09}},
                                      {150.0, {0.66, 0.25, 0.16}},
                                      {230.0, {0.88, 0.50, 0.31}},
                                      {330.0, {0.97, 0.74, 0.54}},
                                      {550.0, {1.00, 0.90, 0.78}},
                                      {800.0, {1.00, 1.00, 1.00}}},
                                     {{0.0, 0.0},
                                      {60.0, 0.09},
                                      {110.0, 0.16},
                                      {180.0, 0.30},
                                      {260.0, 0.60},
                                      {600.0, 0.80},
                                      {900.0, 0.95}}}};
  static const PresetTable vessels{
      250.0,
      {{{-30.0, {0.55, 0.22, 0.16}},
        {130.0, {0.72, 0.32, 0.24}},
        {266.0, {0.90, 0.55, 0.42}},
        {450.0, {1.00, 0.85, 0.72}},
        {650.0, {1.00, 0.97, 0.90}},
        {730.0, {1.00, 1.00, 1.00}}},
       {{-6.0, 0.0}, {90.0, 0.012}, {186.0, 0.02}, {314.0, 0.30}, {650.0, 0.30}, {730.0, 0.9}}}};
  static const PresetTable soft_tissue{
      80.0,
      {{{-60.0, {0.80, 0.62, 0.42}},
        {20.0, {0.72, 0.36, 0.28}},
        {120.0, {0.80, 0.40, 0.32}},
        {260.0, {0.93, 0.66, 0.50}},
        {500.0, {1.00, 0.92, 0.82}},
        {800.0, {1.00, 1.00, 1.00}}},
       {{-40.0, 0.0}, {10.0, 0.12}, {60.0, 0.40}, {200.0, 0.55}, {600.0, 0.85}}}};
  static const PresetTable bone{350.0,
                                {{{200.0, {0.72, 0.50, 0.36}},
                                  {350.0, {0.90, 0.78, 0.62}},
                                  {600.0, {0.97, 0.93, 0.84}},
                                  {1000.0, {1.00, 1.00, 1.00}}},
                                 {{220.0, 0.0}, {320.0, 0.18}, {500.0, 0.65}, {900.0, 0.95}}}};
  switch (preset) {
    case VolumePreset::coronary:
      return coronary;
    case VolumePreset::vessels:
      return vessels;
    case VolumePreset::soft_tissue:
      return soft_tissue;
    case VolumePreset::bone:
      return bone;
  }
  throw InvalidInput("there is no such look of the volume");
}

/// The place of `hu` between two points, the last one where it is beyond them: index of the first, and share.
template <class Point>
std::pair<std::size_t, double> place_between(const std::vector<Point>& points, double hu) {
  if (hu <= points.front().hu) return {0, 0.0};
  for (std::size_t n = 0; n + 1 < points.size(); ++n)
    if (hu <= points[n + 1].hu) return {n, (hu - points[n].hu) / (points[n + 1].hu - points[n].hu)};
  return {points.size() - 2, 1.0};
}

}  // namespace

void validate(const VolumeLook& look) {
  if (!(look.shift_hu >= -2000.0 && look.shift_hu <= 2000.0))
    throw InvalidInput("a shift of " + std::to_string(look.shift_hu) +
                       " HU is not possible, it has to be between -2000 and 2000 HU");
  if (!(look.stretch >= 0.2 && look.stretch <= 5.0))
    throw InvalidInput("a stretch of " + std::to_string(look.stretch) +
                       " is not possible, it has to be between 0.2 and 5");
}

VolumeTransfer transfer_of(const VolumeLook& look) {
  validate(look);
  const PresetTable& table = table_of(look.preset);
  VolumeTransfer transfer = table.transfer;
  const auto moved = [&](double hu) {
    return table.middle_hu + look.stretch * (hu - table.middle_hu) + look.shift_hu;
  };
  for (ColorAtHu& each : transfer.colors) each.hu = moved(each.hu);
  for (OpacityAtHu& each : transfer.opacities) each.hu = moved(each.hu);
  return transfer;
}

double opacity_at(const VolumeTransfer& transfer, double hu) {
  const auto [n, share] = place_between(transfer.opacities, hu);
  return std::lerp(transfer.opacities[n].opacity, transfer.opacities[n + 1].opacity, share);
}

figure::Color color_at(const VolumeTransfer& transfer, double hu) {
  const auto [n, share] = place_between(transfer.colors, hu);
  return figure::mixed(transfer.colors[n].color, transfer.colors[n + 1].color, share);
}

std::vector<std::int64_t> histogram(const imaging::ImageVolume& image, double low_hu, double high_hu,
                                    int bins) {
  if (bins < 1 || !(high_hu > low_hu))
    throw InvalidInput("a histogram needs a bin at least and a range of CT numbers that is not empty");
  std::vector<std::int64_t> counts(static_cast<std::size_t>(bins), 0);
  const double per_hu = bins / (high_hu - low_hu);
  for (const std::int16_t value : image.voxels) {
    const double bin = (static_cast<double>(value) - low_hu) * per_hu;
    if (bin >= 0.0 && bin < bins) ++counts[static_cast<std::size_t>(bin)];
  }
  return counts;
}

}  // namespace ostia::view
