// An archive by DICOMweb: QIDO-RS, WADO-RS, STOW-RS (PS3.18 10).

#include "dicom_json.h"
#include "http.h"
#include "intake.h"
#include "multipart.h"
#include "part_files.h"
#include "text.h"
#include "transports.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <random>
#include <set>
#include <utility>

namespace ostia::pacs {
namespace {

constexpr std::size_t most_a_page = 1000;

std::string encoded(std::string_view text) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                       c == '-' || c == '.' || c == '_' || c == '~' || c == '*';
    if (plain)
      result += c;
    else
      result += {'%', digits[byte >> 4], digits[byte & 15]};
  }
  return result;
}

std::string query_path(const Query& query, std::size_t limit, std::size_t offset) {
  std::string path = "/studies";
  if (query.level != Level::study) path += "/" + query.study_uid + "/series";
  if (query.level == Level::image) path += "/" + query.series_uid + "/instances";
  path += "?limit=" + std::to_string(limit) + "&offset=" + std::to_string(offset);
  const auto add = [&path](const char* name, const std::string& value) {
    if (!value.empty()) path += std::string("&") + name + "=" + encoded(value);
  };
  if (query.level == Level::study) {
    add("PatientName", query.patient_name);
    add("PatientID", query.patient_id);
    if (!query.from_date.empty() || !query.to_date.empty())
      add("StudyDate", query.from_date + "-" + query.to_date);
    add("StudyDescription", query.description);
    add("ModalitiesInStudy", query.modality);
    add("StudyInstanceUID", query.study_uid);
    path += "&includefield=00081030&includefield=00201208&includefield=00080061";
  } else if (query.level == Level::series) {
    add("SeriesInstanceUID", query.series_uid);
    add("Modality", query.modality);
    add("SeriesDescription", query.description);
    path += "&includefield=0008103E&includefield=00201209";
  }
  return path;
}

std::string random_boundary() {
  std::random_device device;
  std::string text = "ostia";
  for (int n = 0; n < 4; ++n) text += std::to_string(device());
  return text;
}

/// One file as the body of a STOW-RS request, read as it is sent.
class StowBody {
 public:
  StowBody(const std::filesystem::path& file, const std::string& boundary)
      : head_("--" + boundary + "\r\nContent-Type: application/dicom\r\n\r\n"),
        tail_("\r\n--" + boundary + "--\r\n"),
        file_(std::fopen(file.c_str(), "rbe"),
              [](std::FILE* open) { return open != nullptr ? std::fclose(open) : 0; }) {
    std::error_code error;
    file_bytes_ = std::filesystem::file_size(file, error);
    if (!file_ || error) throw IoError("the file cannot be read");
  }
  std::uint64_t size() const { return head_.size() + file_bytes_ + tail_.size(); }
  std::size_t read(char* buffer, std::size_t size) {
    if (const std::size_t count = taken(head_, buffer, size)) return count;
    if (const std::size_t count = std::fread(buffer, 1, size, file_.get())) return count;
    if (std::ferror(file_.get()) != 0) throw IoError("the file cannot be read");
    return taken(tail_, buffer, size);
  }

 private:
  static std::size_t taken(std::string& from, char* buffer, std::size_t size) {
    const std::size_t count = from.copy(buffer, size);
    from.erase(0, count);
    return count;
  }
  std::string head_, tail_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::uint64_t file_bytes_ = 0;
};

class DicomwebArchive final : public Archive {
 public:
  DicomwebArchive(ServerDescription description, Secrets secrets)
      : Archive(std::move(description)), secrets_(std::move(secrets)), http_(server(), secrets_) {}

  void echo(const core::TaskContext& task) override {
    task.set_stage("asking");
    const HttpAnswer answer = http_.request({"/studies?limit=1", {accept_json}}, task);
    require_success(server(), answer, "the search");
    if (answer.status != 204) page_of(answer, Level::study);
  }

  FindResult find(const Query& query, const core::TaskContext& task) override {
    validate(query);
    FindResult result;
    std::set<std::string> known;
    std::size_t without_uid = 0;
    for (std::size_t offset = 0;;) {
      const std::size_t limit = std::min(query.most + 1 - result.found.size(), most_a_page);
      const HttpAnswer answer = http_.request({query_path(query, limit, offset), {accept_json}}, task);
      require_success(server(), answer, "the search");
      if (answer.status == 204) break;
      const FoundPage page = page_of(answer, query.level);
      bool anything_new = false;
      for (const Found& one : page.found) {
        if (!known.insert(one.study_uid + " " + one.series_uid + " " + one.sop_uid).second) continue;
        anything_new = true;
        result.found.push_back(one);
      }
      if (anything_new || offset == 0) without_uid += page.without_uid;
      offset += page.entries;
      // A server may give fewer at a time than it is asked for, or know no offset: what is new decides.
      if (!anything_new || result.found.size() > query.most) break;
    }
    result.cut_off = result.found.size() > query.most;
    if (result.cut_off) result.found.resize(query.most);
    if (without_uid > 0)
      result.warnings.push_back(std::to_string(without_uid) + " entries without a UID are left out");
    return result;
  }

 protected:
  void retrieve(const SeriesWanted& wanted, const std::vector<std::string>& missing, Intake& intake,
                const core::TaskContext& task) override {
    const std::string series = "/studies/" + wanted.study_uid + "/series/" + wanted.series_uid;
    if (missing.empty()) return retrieve_path(series, intake, task);
    for (const std::string& image : missing) retrieve_path(series + "/instances/" + image, intake, task);
  }

  void store(const std::vector<std::filesystem::path>& files, std::vector<SendResult>& results,
             const core::TaskContext& task) override {
    for (std::size_t n = 0; n < files.size(); ++n) {
      results.push_back(stored(files[n], task));
      task.set_stage("sending " + std::to_string(n + 1) + " of " + std::to_string(files.size()));
      task.set_progress(static_cast<double>(n + 1) / static_cast<double>(files.size()));
    }
  }

 private:
  static constexpr const char* accept_json = "Accept: application/dicom+json";

  FoundPage page_of(const HttpAnswer& answer, Level level) const {
    try {
      return found_in_json(answer.body, level);
    } catch (const InvalidInput& error) {
      throw InvalidInput("the server '" + server().name + "' " + error.what() + "; is url right?");
    }
  }

  void retrieve_path(const std::string& path, Intake& intake, const core::TaskContext& task) {
    PartFiles files(intake);
    std::optional<MultipartParser> parser;
    const auto sink = [&](const std::string& type, std::string_view bytes) {
      if (!parser) {
        const std::string boundary = boundary_of(type);
        if (boundary.empty()) throw InvalidInput("sends images as something else than multipart/related");
        parser.emplace(boundary, files);
      }
      parser->feed(bytes);
    };
    const HttpAnswer answer = http_.request(
        {path, {"Accept: multipart/related; type=\"application/dicom\"; transfer-syntax=*"}}, task, sink);
    require_success(server(), answer, "the retrieval");
    if (!parser || !parser->finished())
      throw NetworkError("the answer of the server '" + server().name + "' ends too early");
  }

  SendResult stored(const std::filesystem::path& file, const core::TaskContext& task) {
    const std::string boundary = random_boundary();
    std::optional<StowBody> body;
    HttpAnswer answer;
    try {
      body.emplace(file, boundary);
      HttpRequest request{
          "/studies",
          {accept_json, "Content-Type: multipart/related; type=\"application/dicom\"; boundary=" + boundary},
          true,
          body->size(),
          [&](char* buffer, std::size_t size) { return body->read(buffer, size); }};
      answer = http_.request(request, task);
    } catch (const IoError& error) {
      return {SendState::refused, error.what()};
    }
    const std::uint32_t failure = failure_in_json(answer.body);
    if (failure == 0x0111) return {};  // it is there already
    if (failure == 0x0122) return {SendState::refused, "the server does not take objects of this kind"};
    if ((failure & 0xFF00) == 0xA700)
      return {SendState::unreachable,
              "the server has no room for it now (failure reason " + hexadecimal(failure) + ")"};
    if (failure != 0)
      return {SendState::refused, "the server refuses it (failure reason " + hexadecimal(failure) + ")"};
    const bool lets_in = answer.status != 401 && answer.status != 403;
    if (answer.status >= 400 && answer.status < 500 && lets_in && answer.status != 408 &&
        answer.status != 429)
      return {SendState::refused, "the server refuses it (HTTP " + std::to_string(answer.status) + ")"};
    require_success(server(), answer, "the storing");
    return {};
  }

  Secrets secrets_;
  HttpClient http_;
};

}  // namespace

std::unique_ptr<Archive> dicomweb_archive(const ServerDescription& server, const Secrets& secrets) {
  return std::make_unique<DicomwebArchive>(server, secrets);
}

}  // namespace ostia::pacs
