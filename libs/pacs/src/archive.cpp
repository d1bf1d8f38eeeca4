#include "ostia/pacs/archive.h"

#include "intake.h"
#include "pause.h"
#include "transports.h"
#include "uid.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"

#include <algorithm>
#include <set>
#include <utility>

namespace ostia::pacs {
namespace {

constexpr std::size_t most_images = 100000;  // of one series

bool is_date(const std::string& text) {
  return text.size() == 8 &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

void require_text(const std::string& text, const char* member) {
  const bool sound = text.size() <= 256 && std::none_of(text.begin(), text.end(), [](char c) {
                       return static_cast<unsigned char>(c) < 0x20 || c == 0x7F || c == '\\';
                     });
  if (!sound)
    throw InvalidInput(std::string("the query's ") + member +
                       " must have no backslash or control character, and 256 bytes at most");
}

[[noreturn]] void refuse_so_many(const ServerDescription& server) {
  throw InvalidInput("the server '" + server.name + "' lists more than " + std::to_string(most_images) +
                     " images in this series");
}

bool is_ascii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

/// Whose study it is: nothing where it is not told in ASCII.
std::string patient_of(Archive& archive, const SeriesWanted& wanted, const core::TaskContext& task) {
  Query study;
  study.study_uid = wanted.study_uid;
  study.most = 2;
  // Letters beyond ASCII are written in another way in the files: then all need only be of the same patient.
  for (const Found& one : archive.find(study, task).found)
    if (one.study_uid == wanted.study_uid && is_ascii(one.patient_id)) return one.patient_id;
  return {};
}

/// How many images the server says that the series has, which is much sooner answered than which ones they
/// are; 0 where it does not say, and where they may be of classes that are asked for by what is listed alone.
std::size_t images_said(Archive& archive, const SeriesWanted& wanted, const core::TaskContext& task) {
  Query series;
  series.level = Level::series;
  series.study_uid = wanted.study_uid;
  series.series_uid = wanted.series_uid;
  for (const Found& one : archive.find(series, task).found)
    if (one.series_uid == wanted.series_uid && one.images > 0 &&
        (one.modality.empty() || one.modality == "CT" || one.modality == "MR"))
      return static_cast<std::size_t>(one.images);
  return 0;
}

/// The images that the server lists, one at least.
std::vector<Found> listed_images(Archive& archive, const SeriesWanted& wanted,
                                 const core::TaskContext& task) {
  Query images;
  images.level = Level::image;
  images.study_uid = wanted.study_uid;
  images.series_uid = wanted.series_uid;
  images.most = most_images;
  FindResult result = archive.find(images, task);
  if (result.cut_off) refuse_so_many(archive.server());
  std::erase_if(result.found, [](const Found& one) { return !is_uid(one.sop_uid); });
  if (result.found.empty())
    throw InvalidInput("the server '" + archive.server().name + "' has no image of this series");
  return std::move(result.found);
}

void expect(Intake& intake, const std::vector<Found>& images) {
  std::set<std::string> uids, classes;
  for (const Found& one : images) {
    uids.insert(one.sop_uid);
    if (is_uid(one.sop_class)) classes.insert(one.sop_class);
  }
  intake.expect(std::move(uids), std::move(classes));
}

std::string how_many(std::size_t count, const char* noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace

void validate(const Query& query) {
  require_text(query.patient_name, "patient_name");
  require_text(query.patient_id, "patient_id");
  require_text(query.description, "description");
  require_text(query.modality, "modality");
  for (const auto& [date, member] :
       {std::pair(&query.from_date, "from_date"), std::pair(&query.to_date, "to_date")})
    if (!date->empty() && !is_date(*date))
      throw InvalidInput(std::string("the query's ") + member + " must be YYYYMMDD");
  if (!query.study_uid.empty() && !is_uid(query.study_uid))
    throw InvalidInput("the query's study_uid is no UID");
  if (!query.series_uid.empty() && !is_uid(query.series_uid))
    throw InvalidInput("the query's series_uid is no UID");
  if (query.level != Level::study && query.study_uid.empty())
    throw InvalidInput("a query for series or images needs the study's UID");
  if (query.level == Level::image && query.series_uid.empty())
    throw InvalidInput("a query for images needs the series' UID");
  if (query.most < 1 || query.most > 1000000) throw InvalidInput("the query's most must be 1 to 1000000");
}

Fetched Archive::fetch(const SeriesWanted& wanted, const std::filesystem::path& folder,
                       const core::TaskContext& task) {
  if (!is_uid(wanted.study_uid) || !is_uid(wanted.series_uid))
    throw InvalidInput("a series is asked for by its study's UID and its own");
  if (std::filesystem::exists(folder)) throw InvalidInput(folder.string() + " is there already");
  core::StagedFolder staged(folder);
  std::filesystem::permissions(staged.temporary(), std::filesystem::perms::owner_all);
  task.set_stage("asking");
  const std::string patient = patient_of(*this, wanted, task);
  const std::size_t images = images_said(*this, wanted, task);
  if (images > most_images) refuse_so_many(server_);
  Intake intake(staged.temporary(), wanted, patient, images, task.sub(0.02, 0.99));
  std::string last;
  for (int attempt = 1; attempt <= server_.attempts && !intake.complete(); ++attempt) {
    if (attempt > 1) pause_before(attempt, task);
    last = attempted(wanted, intake, attempt > 1 || images == 0, task);
  }
  if (!intake.complete())
    throw NetworkError("the server '" + server_.name + "' lists " + how_many(intake.announced(), "image") +
                       " of this series and sent " + std::to_string(intake.received() - intake.unlisted()) +
                       "; nothing is kept, try again" + (last.empty() ? "" : " (" + last + ")"));
  Fetched fetched;
  fetched.announced = intake.announced();
  fetched.duplicates = intake.duplicates();
  if (fetched.duplicates > 0)
    fetched.warnings.push_back("the server sent " + how_many(fetched.duplicates, "image") +
                               " twice; one of each is kept");
  if (intake.unlisted() > 0)
    fetched.warnings.push_back("the server sent " + how_many(intake.unlisted(), "image") +
                               " that it does not list; kept");
  for (const std::filesystem::path& file : intake.files()) fetched.files.push_back(folder / file.filename());
  for (const auto& entry : std::filesystem::directory_iterator(staged.temporary()))
    if (entry.path().extension() != ".dcm") std::filesystem::remove(entry.path());
  staged.commit();
  task.set_progress(1.0);
  return fetched;
}

std::filesystem::path Archive::fetch_middle(const SeriesWanted& wanted, const std::filesystem::path& folder,
                                            const core::TaskContext& task) {
  std::vector<Found> images = listed_images(*this, wanted, task);
  // UIDs of a scanner count upwards: by length, then by digits, the middle one is about the middle slice.
  const auto middle = images.begin() + static_cast<std::ptrdiff_t>(images.size() / 2);
  std::nth_element(images.begin(), middle, images.end(), [](const Found& a, const Found& b) {
    return std::pair(a.sop_uid.size(), a.sop_uid) < std::pair(b.sop_uid.size(), b.sop_uid);
  });
  if (std::filesystem::exists(folder)) throw InvalidInput(folder.string() + " is there already");
  core::StagedFolder staged(folder);
  std::filesystem::permissions(staged.temporary(), std::filesystem::perms::owner_all);
  Intake intake(staged.temporary(), wanted, {}, 1, task);
  expect(intake, {*middle});
  retrieve(wanted, {middle->sop_uid}, intake, task);
  task.throw_if_cancelled();
  intake.throw_if_faulty();
  if (!intake.complete()) throw NetworkError("the server '" + server_.name + "' did not send the image");
  const std::string name = middle->sop_uid + ".dcm";
  std::vector<std::filesystem::path> others;  // that it sent, too
  for (const auto& entry : std::filesystem::directory_iterator(staged.temporary()))
    if (entry.path().filename() != name) others.push_back(entry.path());
  for (const std::filesystem::path& other : others) std::filesystem::remove(other);
  staged.commit();
  return folder / name;
}

std::string Archive::attempted(const SeriesWanted& wanted, Intake& intake, bool list_first,
                               const core::TaskContext& task) {
  std::string broken;
  try {
    if (list_first && !intake.has_list()) expect(intake, listed_images(*this, wanted, task));
    if (!intake.complete())
      retrieve(wanted, intake.received() == 0 ? std::vector<std::string>{} : intake.missing(), intake, task);
    if (!intake.complete() && !intake.has_list() && intake.fault().empty()) {
      // Nothing broke, and it is not as many as it said: what it lists decides.
      expect(intake, listed_images(*this, wanted, task));
      if (!intake.complete()) retrieve(wanted, intake.missing(), intake, task);
    }
  } catch (const NetworkError& error) {
    broken = error.what();
  } catch (const InvalidInput&) {
    if (intake.fault().empty()) throw;
  }
  task.throw_if_cancelled();
  if (!intake.fault().empty())
    throw InvalidInput("the server '" + server_.name + "' " + intake.fault() + "; nothing is kept");
  intake.throw_if_faulty();
  return broken;
}

std::vector<SendResult> Archive::send(const std::vector<std::filesystem::path>& files,
                                      const core::TaskContext& task) {
  std::vector<SendResult> results;
  std::string last;
  for (int attempt = 1; attempt <= server_.attempts && results.size() < files.size(); ++attempt) {
    if (attempt > 1) pause_before(attempt, task);
    const auto first = static_cast<std::ptrdiff_t>(results.size());
    try {
      store({files.begin() + first, files.end()}, results, task);
    } catch (const NetworkError& error) {
      last = error.what();
    } catch (const InvalidInput& error) {  // no association: it will refuse the next attempt, too
      task.throw_if_cancelled();
      results.resize(files.size(), {SendState::refused, error.what()});
    }
    task.throw_if_cancelled();
  }
  results.resize(files.size(), {SendState::unreachable, last});
  return results;
}

std::unique_ptr<Archive> open_archive(const ServerDescription& server, const Secrets& secrets) {
  validate(server);
  return server.transport == Transport::dimse ? dimse_archive(server, secrets)
                                              : dicomweb_archive(server, secrets);
}

}  // namespace ostia::pacs
