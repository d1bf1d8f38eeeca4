// The whole way of a patient's scan: from an archive that is not ours, by TLS and with a login, to a checked
// tree and back into the archive, where other programs get and read what was made of it.

#include "kept_scan.h"
#include "local_orthanc.h"
#include "program.h"

#include "ostia/core/files.h"
#include "ostia/imaging/dicom_writer.h"
#include "ostia/session/case_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <memory>
#include <numbers>

namespace ostia::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;
namespace fs = std::filesystem;

/// Runs a line of the shell in a folder; what it says comes back.
std::string shell(const fs::path& folder, const std::string& line, bool& good) {
  const fs::path log = folder / "shell.log";
  good = std::system(("cd " + quoted(folder.string()) + " && ( " + line + " ) > " + quoted(log.string()) +
                      " 2>&1 < /dev/null")
                         .c_str()) == 0;
  return core::read_file(log);
}

std::string missing_program(const fs::path& folder) {
  for (const char* name : {"getscu", "curl", "dciodvfy"}) {
    bool there = false;
    shell(folder, std::string("command -v ") + name, there);
    if (!there) return name;
  }
  bool there = false;
  shell(folder, "/usr/bin/python3 -c 'import pydicom'", there);
  return there ? "" : "pydicom";
}

struct PacsWalk : ::testing::Test {
  const Setting in{temporary_folder("walk"), ""};
  std::unique_ptr<LocalOrthanc> orthanc;

  Json done(const std::vector<std::string>& command) {
    const Outcome outcome = ostia(command + std::vector<std::string>{"--json"}, in);
    EXPECT_EQ(outcome.code, 0) << command.front() << " " << command[1] << ": " << outcome.err;
    return Json::parse(outcome.out, nullptr, false);
  }
  Json pacs(std::vector<std::string> command) {
    command.insert(command.begin(), "pacs");
    return done(command + std::vector<std::string>{"--servers", "servers.json", "--password-file", "secret"});
  }
  std::string said(const std::string& line) {
    bool good = false;
    const std::string text = shell(in.folder, line, good);
    EXPECT_TRUE(good) << line << "\n" << text;
    return text;
  }

  void describe_servers() {
    pacs::ServerDescription dicom = orthanc->by_get(), web = orthanc->by_web();
    dicom.name = "dicom";
    web.name = "web";
    pacs::write_servers(in.folder / "servers.json", {dicom, web});
    core::write_file(in.folder / "secret", "open sesame\n");
    fs::permissions(in.folder / "secret", fs::perms(0600));
    fs::copy_file(dicom.authorities, in.folder / "authority.pem");
  }
  /// As a scanner does.
  void bring_scan() {
    phantom::CaseOptions options;
    options.preset = phantom::Preset::small;
    imaging::DicomSeriesOptions names;
    names.patient_name = "PLANTED^WALK";
    names.patient_id = "WALK-1";
    imaging::write_dicom_series(in.folder / "scanner", kept_scan(phantom::plan_case(options)).image, names);
    pacs({"send", "dicom", "scanner"});
  }
  /// Narrows the longest vessel's lumen somewhere, in the case itself.
  void edit_case() {
    session::CaseFile file = session::CaseFile::open(in.folder / "heart.ostia");
    const lumen::LumenModel& model = *file.model();
    const auto& vessel = *model.vessels.front();
    const double s_mm = 0.5 * vessel.axis->length();
    lumen::SectionContour ring;
    ring.vessel = model.tree.vessels.front().id;
    ring.s_mm = s_mm;
    ring.eps_mm = 3.0;
    for (int i = 0; i < 12; ++i)
      ring.points.push_back(vessel.axis->place(s_mm, std::numbers::pi * i / 6.0, 0.8));
    file.apply(ring);
  }
};

TEST_F(PacsWalk, AScanIsFoundAndWhatWasMadeOfItIsReadByOthers) {
  OSTIA_REQUIRE_ORTHANC();
  if (const std::string name = missing_program(in.folder); !name.empty()) GTEST_SKIP() << "needs " << name;
  orthanc = std::make_unique<LocalOrthanc>(OrthancSetting{true, {}});
  ASSERT_TRUE(orthanc->running()) << orthanc->log();
  describe_servers();
  bring_scan();

  const Json studies = pacs({"find", "web", "--patient-name", "PLANTED*"});
  ASSERT_EQ(studies["found"].size(), 1U) << studies;
  const std::string study = studies["found"][0]["study_uid"];
  const Json all_series = pacs({"find", "dicom", "--study", study});
  ASSERT_EQ(all_series["found"].size(), 1U) << all_series;
  const std::string series = all_series["found"][0]["series_uid"];
  pacs({"get", "web", "--study", study, "--series", series, "-o", "CT"});

  done({"extract", "CT", "-o", "heart.ostia"});
  edit_case();
  const Json replayed = done({"replay", "heart.ostia"});
  EXPECT_EQ(replayed["same"], true);
  EXPECT_EQ(replayed["edits"], 1);
  const Json made =
      done({"dicom", "heart.ostia", "--series", "CT", "-o", "objects", "--objects", "seg,sr,pdf,stl"});
  ASSERT_EQ(made["objects"].size(), 4U);
  const Json sent = pacs({"send", "dicom", "objects", "--queue", "outbox"});
  EXPECT_EQ(pacs({"find", "web", "--study", study})["found"].size(), 5U) << sent;

  // DCMTK gets what its program knows, which leaves the surface out; curl gets all four.
  fs::create_directory(in.folder / "dcmtk");
  fs::create_directory(in.folder / "curl");
  const TlsBack by_tls(orthanc->dicom_port(), in.folder / "authority.pem");  // getscu 3.6.7 knows none
  const std::string web = orthanc->by_web().url;
  for (const Json& one : made["objects"]) {
    const std::string name = one["file"], sop = one["sop_instance"], of = one["series"];
    if (one["kind"] != "stl")
      said("getscu -S -aec ORTHANC -k QueryRetrieveLevel=SERIES -k StudyInstanceUID=" + study +
           " -k SeriesInstanceUID=" + of + " -od dcmtk localhost " + std::to_string(by_tls.port()));
    said("curl -s -f --cacert authority.pem -u 'ostia:open sesame' -o curl/" + name + " '" +
         web.substr(0, web.rfind('/')) + "/wado?requestType=WADO&contentType=application/dicom&studyUID=" +
         study + "&seriesUID=" + of + "&objectUID=" + sop + "'");
    EXPECT_THAT(said("dciodvfy curl/" + name + " || true"), ::testing::Not(HasSubstr("Error"))) << name;
  }
  core::write_file(in.folder / "same.py", R"(import glob, pydicom
sent = {d.SOPInstanceUID: d for d in map(pydicom.dcmread, glob.glob('objects/*.dcm'))}
for folder, count in (('curl', 4), ('dcmtk', 3)):
    got = [pydicom.dcmread(f) for f in glob.glob(folder + '/*')]
    assert len(got) == count, (folder, len(got))
    for d in got:
        assert d == sent[d.SOPInstanceUID], (folder, d.SOPClassUID)
        assert d.PatientName == 'PLANTED^WALK' and d.PatientID == 'WALK-1'
print('all the same')
)");
  EXPECT_THAT(said("PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 same.py"), HasSubstr("all the same"));

  // Orthanc itself reads each one's attributes and draws the segmentation.
  const std::string ask = "curl -s -f -u 'ostia:open sesame' ";
  for (const Json& one : made["objects"]) {
    const std::string sop = one["sop_instance"];
    const Json found = Json::parse(said(ask + "-d " + sop + " " + orthanc->rest_url() + "/tools/lookup"));
    ASSERT_EQ(found.size(), 1U) << one;
    const std::string at = orthanc->rest_url() + "/instances/" + found[0]["ID"].get<std::string>();
    EXPECT_EQ(Json::parse(said(ask + at + "/simplified-tags"))["PatientName"], "PLANTED^WALK");
    if (one["kind"] == "seg") {
      said(ask + "-o seg.png " + at + "/preview");
      EXPECT_THAT(core::read_file(in.folder / "seg.png"), ::testing::StartsWith("\x89PNG"));
    }
    if (one["kind"] == "pdf") {
      said(ask + "-o report.pdf " + at + "/pdf");
      EXPECT_THAT(core::read_file(in.folder / "report.pdf"), ::testing::StartsWith("%PDF-"));
    }
  }
  // Sent again there is no copy.
  pacs({"send", "web", "objects"});
  EXPECT_EQ(pacs({"find", "dicom", "--study", study})["found"].size(), 5U);
}

}  // namespace
}  // namespace ostia::testing
