// A series from an image archive: searched, listed, fetched and opened, while the window goes on; what goes
// wrong is said.

#include "archive/dialog.h"
#include "fake_keyring.h"
#include "fake_server.h"
#include "opening/opening.h"
#include "shared_data.h"
#include "small_series.h"
#include "test_desk.h"

#include <gmock/gmock.h>

#include <QCheckBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTreeWidget>

namespace ostia::workstation {
namespace {

using ostia::testing::FakeServer;
using ostia::testing::http_answer;
using ostia::testing::small_series;
using ostia::testing::SmallSeries;
using ::testing::HasSubstr;
using testing::wait_until;

struct ArchiveWindow : ::testing::Test {
  SmallSeries series = small_series("window", 12);
  std::string password = "open sesame";
  bool answers = true;
  FakeServer web{[this](const std::string& request) { return answer(request); }};
  testing::TestDesk test{ostia::testing::temporary_folder("archive-desk")};
  Opening opening{test.desk()};
  testing::FakeKeyring keyring;

  std::string answer(const std::string& request) const {
    if (!answers) return {};
    if (request.find("Authorization: Basic") == std::string::npos) return http_answer(401, "text/plain", "");
    const auto json = [](const std::string& body) {
      return http_answer(200, "application/dicom+json", body);
    };
    if (request.find("/instances?") != std::string::npos) {
      std::string body;
      for (const std::string& uid : series.sop_uids)
        body += (body.empty() ? "[" : ",") + (R"({"00080018":{"Value":[")" + uid + R"("]}})");
      return json(body + "]");
    }
    const std::string study =
        R"("0020000D":{"Value":[")" + series.study_uid +
        R"("]},"00100020":{"Value":["PID-1"]},"00100010":{"Value":[{"Alphabetic":"DOE^JANE"}]})";
    if (request.find("/series?") != std::string::npos)
      return json("[{" + study + R"(,"0020000E":{"Value":[")" + series.series_uid +
                  R"("]},"00201209":{"Value":[12]}}])");
    if (request.find("/studies?") != std::string::npos) return json("[{" + study + "}]");
    return http_answer(200, "multipart/related; boundary=b", ostia::testing::multipart_body(series.bytes));
  }
  ArchiveDialog& dialog() {
    if (!dialog_) {
      pacs::ServerDescription server;
      server.name = "hospital";
      server.transport = pacs::Transport::dicomweb;
      server.url = "http://127.0.0.1:" + std::to_string(web.port()) + "/dicom-web";
      server.login = pacs::Login::basic;
      server.user = "ostia";
      server.attempts = 1;
      test.show();
      dialog_ = new ArchiveDialog({server}, keyring, test.desk(), opening);
      dialog_->show();
    }
    return *dialog_;
  }
  template <class Widget>
  Widget& part(const char* name) {
    auto* found = dialog().findChild<Widget*>(name);
    if (!found) throw std::runtime_error(name);
    return *found;
  }
  void search() {
    part<QLineEdit>("archive_password").setText(QString::fromStdString(password));
    part<QPushButton>("archive_search").click();
    EXPECT_TRUE(test.idle());
  }
  std::string said() { return part<QLabel>("archive_said").text().toStdString(); }
  QTreeWidget& found() { return part<QTreeWidget>("archive_found"); }

 private:
  ArchiveDialog* dialog_ = nullptr;  // its window's
};

TEST_F(ArchiveWindow, ASeriesIsSearchedFetchedAndOpened) {
  search();
  ASSERT_EQ(found().topLevelItemCount(), 1);
  EXPECT_THAT(found().topLevelItem(0)->text(0).toStdString(), HasSubstr("DOE^JANE"));
  EXPECT_FALSE(part<QPushButton>("archive_open").isEnabled()) << "a study is no image";
  found().topLevelItem(0)->setExpanded(true);
  ASSERT_TRUE(wait_until([&] { return found().topLevelItem(0)->childCount() == 1; }));
  found().setCurrentItem(found().topLevelItem(0)->child(0));
  ASSERT_TRUE(part<QPushButton>("archive_open").isEnabled());
  part<QPushButton>("archive_open").click();
  ASSERT_TRUE(wait_until([&] { return test.bench().image().volume && !test.desk().jobs.any(); }, 60000));
  EXPECT_EQ(test.bench().image().volume->geometry.size[2], 12);
  const auto kept = test.desk().state_folder / "archive";
  EXPECT_EQ(std::filesystem::status(kept).permissions(), std::filesystem::perms::owner_all);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(kept), {}), 1);
}

TEST_F(ArchiveWindow, AnUnfoldedStudyShowsAPictureOfEachSeries) {
  search();
  found().topLevelItem(0)->setExpanded(true);
  ASSERT_TRUE(wait_until([&] { return found().topLevelItem(0)->childCount() == 1; }));
  QTreeWidgetItem* item = found().topLevelItem(0)->child(0);
  const auto picture = [&] { return item->icon(0).pixmap(72, 72).toImage(); };
  const QImage none = picture();
  ASSERT_TRUE(wait_until([&] { return picture() != none; }, 30000)) << item->toolTip(0).toStdString();
  EXPECT_EQ(picture().size(), QSize(72, 72));
  EXPECT_TRUE(test.idle());
  EXPECT_FALSE(std::filesystem::exists(test.desk().state_folder / "archive")) << "nothing of it is kept";
}

TEST_F(ArchiveWindow, APasswordIsKeptInTheKeyringWhereThePersonWantsIt) {
  search();
  EXPECT_TRUE(keyring.kept["hospital"].isEmpty());
  part<QCheckBox>("archive_remember").setChecked(true);
  search();
  EXPECT_EQ(keyring.kept["hospital"], "open sesame");
}

TEST_F(ArchiveWindow, WhatGoesWrongIsSaidInTheDialog) {
  answers = false;
  search();
  EXPECT_THAT(said(), HasSubstr("hospital"));
  EXPECT_EQ(found().topLevelItemCount(), 0);
}

}  // namespace
}  // namespace ostia::workstation
