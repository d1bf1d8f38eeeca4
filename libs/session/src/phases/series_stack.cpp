#include "ostia/session/series_stack.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>

namespace ostia::session {
namespace fs = std::filesystem;
namespace {

constexpr double one_phase = 1e-6;

/// "CTA 75 % B26f" is 0.75; numbers without a sign of percent say nothing.
std::optional<double> percent_in(const std::string& text) {
  for (std::size_t sign = text.find('%'); sign != std::string::npos; sign = text.find('%', sign + 1)) {
    std::size_t end = sign;
    while (end > 0 && text[end - 1] == ' ') --end;
    std::size_t begin = end;
    while (begin > 0 && (std::isdigit(static_cast<unsigned char>(text[begin - 1])) || text[begin - 1] == '.'))
      --begin;
    if (begin == end) continue;
    const double percent = std::strtod(text.substr(begin, end - begin).c_str(), nullptr);
    if (percent >= 0.0 && percent <= 100.0) return percent >= 100.0 ? 0.0 : percent / 100.0;
  }
  return std::nullopt;
}

std::string uid_of_all_parts(const std::string& uid) {
  return uid.substr(0, uid.find('#'));
}

/// Phases of series that were split by a label: all parts of one series together tell how long the cycle is.
std::map<std::string, double> phases_by_label(const std::vector<const imaging::DicomSeries*>& all) {
  std::map<std::string, std::vector<const imaging::DicomSeries*>> parts;
  for (const imaging::DicomSeries* one : all)
    if (!one->phase.empty()) parts[uid_of_all_parts(one->uid)].push_back(one);
  std::map<std::string, double> found;
  for (const auto& [uid, of] : parts) {
    std::vector<std::string> labels;
    for (const imaging::DicomSeries* one : of) labels.push_back(one->phase);
    std::vector<double> phases;
    try {
      phases = phases_of_labels(labels);
    } catch (const InvalidInput&) {  // times of a part of a cycle: images without a phase are looked at, too
    }
    for (std::size_t n = 0; n < phases.size(); ++n) found[of[n]->uid] = phases[n];
  }
  return found;
}

StackEntry stack_entry(const imaging::DicomSeries& series, const std::map<std::string, double>& by_label) {
  StackEntry entry;
  std::optional<double> phase;
  if (series.cardiac_percent && *series.cardiac_percent >= 0.0 && *series.cardiac_percent <= 100.0)
    phase = *series.cardiac_percent >= 100.0 ? 0.0 : *series.cardiac_percent / 100.0;
  if (const auto label = by_label.find(series.uid); !phase && label != by_label.end()) phase = label->second;
  if (!phase) phase = percent_in(series.description);
  entry.has_phase = phase.has_value();
  entry.source = {phase.value_or(0.0), {}, series};
  entry.description = series.description.empty() ? series.modality : series.description;
  entry.slices = static_cast<std::int64_t>(series.files.size());
  entry.spacing_mm = series.geometry.spacing;
  entry.uneven = series.uneven;
  if (!series.faults.empty()) {
    entry.fault = series.faults.front();
  } else {
    const double voxels = static_cast<double>(series.geometry.size[0]) *
                          static_cast<double>(series.geometry.size[1]) *
                          static_cast<double>(series.geometry.size[2]);
    entry.bytes = static_cast<std::size_t>(2.0 * std::clamp(voxels, 0.0, 1e12));
  }
  return entry;
}

int rank_of(const StackEntry& entry) {
  return !entry.fault.empty() ? 2 : entry.has_phase ? 0 : 1;
}

void put_in_order(std::vector<StackEntry>& entries) {
  std::stable_sort(entries.begin(), entries.end(), [](const StackEntry& a, const StackEntry& b) {
    if (rank_of(a) != rank_of(b)) return rank_of(a) < rank_of(b);
    return rank_of(a) == 0 && a.source.phase < b.source.phase;
  });
}

bool like_voxels(const StackEntry& a, const StackEntry& b) {
  return a.bytes == b.bytes && (a.spacing_mm - b.spacing_mm).norm() < 1e-3;
}

bool in_cine(const StackEntry& entry) {
  return entry.fault.empty() && entry.has_phase && !entry.uneven;
}

}  // namespace

std::size_t SeriesStack::readable() const {
  return static_cast<std::size_t>(
      std::count_if(entries.begin(), entries.end(), [](const StackEntry& one) { return one.fault.empty(); }));
}

bool same_study(const imaging::DicomSeries& a, const imaging::DicomSeries& b) {
  if (a.patient_number != b.patient_number) return false;
  const bool study_told = a.study_number != 0 && b.study_number != 0;
  if (study_told) return a.study_number == b.study_number;
  // Parts of one series are of one study, whatever its files leave out: two are never one series.
  return uid_of_all_parts(a.uid) == uid_of_all_parts(b.uid) ||
         (a.patient_number != 0 && a.study_number == b.study_number);
}

SeriesStack stack_beside(const imaging::DicomFolder& folder, const std::string& own_uid) {
  const auto own = std::find_if(folder.series.begin(), folder.series.end(),
                                [&](const imaging::DicomSeries& one) { return one.uid == own_uid; });
  if (own == folder.series.end()) throw InvalidInput("the folder has no such series");
  SeriesStack stack;
  std::vector<const imaging::DicomSeries*> members;
  for (const imaging::DicomSeries& one : folder.series) {
    if (same_study(one, *own))
      members.push_back(&one);
    else
      ++stack.of_others;
  }
  const std::map<std::string, double> by_label = phases_by_label(members);
  for (const imaging::DicomSeries* one : members) stack.entries.push_back(stack_entry(*one, by_label));
  put_in_order(stack.entries);
  for (std::size_t n = 0; n < stack.entries.size(); ++n)
    if (stack.entries[n].source.series->uid == own_uid) stack.own = n;
  return stack;
}

SeriesStack stack_of_files(const std::vector<PhaseSource>& sources, const fs::path& own) {
  SeriesStack stack;
  for (const PhaseSource& source : sources) {
    StackEntry entry;
    entry.source = source;
    entry.has_phase = true;
    entry.description = source.file.filename().string();
    stack.entries.push_back(std::move(entry));
  }
  put_in_order(stack.entries);
  std::error_code ignored;
  for (std::size_t n = 0; n < stack.entries.size(); ++n)
    if (!own.empty() && fs::equivalent(stack.entries[n].source.file, own, ignored)) stack.own = n;
  return stack;
}

std::vector<std::size_t> cine_of(const SeriesStack& stack) {
  const std::vector<StackEntry>& all = stack.entries;
  std::size_t like = all.size(), most = 0;
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (!in_cine(all[n])) continue;
    const auto count = static_cast<std::size_t>(std::count_if(
        all.begin(), all.end(), [&](const auto& one) { return in_cine(one) && like_voxels(one, all[n]); }));
    if (count > most) most = count, like = n;
  }
  if (stack.own && in_cine(all[*stack.own])) like = *stack.own;
  std::vector<std::size_t> cine;
  for (std::size_t n = 0; n < all.size() && like < all.size(); ++n) {
    if (!in_cine(all[n]) || !like_voxels(all[n], all[like])) continue;
    const bool same = !cine.empty() && all[n].source.phase - all[cine.back()].source.phase < one_phase;
    if (!same)
      cine.push_back(n);
    else if (stack.own == n)
      cine.back() = n;  // of two reconstructions of a phase the one on the table
  }
  return cine.size() > 1 ? cine : std::vector<std::size_t>{};
}

}  // namespace ostia::session
