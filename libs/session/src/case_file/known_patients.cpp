#include "ostia/session/known_patients.h"

#include "case_file/private_file.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <map>
#include <system_error>

namespace ostia::session {
namespace fs = std::filesystem;
namespace {

using PatientsJson = nlohmann::json;

constexpr std::uint64_t largest_patients_file = 4U << 20;

struct SeenPatient {
  imaging::ShownIdentity whose;
  std::int64_t seen = 0;  // milliseconds since 1970 began
};
using SeenPatients = std::map<std::string, SeenPatient>;

std::int64_t now_ms() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
}

SeenPatients patients_of(const std::string& text) {
  SeenPatients all;
  const PatientsJson in = PatientsJson::parse(text);
  if (in.at("v") != 1) return all;
  for (const auto& [sha256, one] : in.at("images").items())
    all[sha256] = {{one.at("name").get<std::string>(), one.at("id").get<std::string>(),
                    one.at("study_date").get<std::string>(), one.at("series").get<std::string>()},
                   one.at("seen").get<std::int64_t>()};
  return all;
}

/// What cannot be read is as if nothing were known: the images say it again.
SeenPatients read_patients(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) return {};
  try {
    return patients_of(core::read_file(file, largest_patients_file));
  } catch (const PatientsJson::exception&) {
  } catch (const Error&) {
  }
  return {};
}

std::string text_of(const SeenPatients& all) {
  PatientsJson out{{"v", 1}, {"images", PatientsJson::object()}};
  for (const auto& [sha256, one] : all)
    out["images"][sha256] = {{"name", one.whose.patient_name},
                             {"id", one.whose.patient_id},
                             {"study_date", one.whose.study_date},
                             {"series", one.whose.series_description},
                             {"seen", one.seen}};
  return out.dump(1, ' ', false, PatientsJson::error_handler_t::replace) + "\n";
}

}  // namespace

std::optional<imaging::ShownIdentity> KnownPatients::find(const std::string& image_sha256) const {
  const SeenPatients all = read_patients(file());
  const auto found = all.find(image_sha256);
  return found == all.end() ? std::nullopt : std::optional(found->second.whose);
}

void KnownPatients::remember(const std::string& image_sha256, const imaging::ShownIdentity& whose) {
  if (whose.anonymous() || image_sha256.empty()) return;
  make_private_folder(folder_);
  const PrivateLock lock(file());
  SeenPatients all = read_patients(file());
  all[image_sha256] = {whose, now_ms()};
  while (all.size() > most)
    all.erase(std::min_element(all.begin(), all.end(),
                               [](const auto& a, const auto& b) { return a.second.seen < b.second.seen; }));
  write_private(file(), text_of(all));
}

void KnownPatients::forget_all() {
  std::error_code error;
  if (!fs::exists(file(), error)) return;
  const PrivateLock lock(file());
  fs::remove(file(), error);
  if (error) raise_file_error("cannot remove", file(), error.value());
}

}  // namespace ostia::session
