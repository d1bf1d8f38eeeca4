// What waits to be sent, and the servers that it goes to, in their dialogs by mouse and keys: an archive that
// is not reached, one that refuses, one that takes it; a password that goes into the keyring alone.

#include "archive/outbox.h"
#include "archive/servers.h"
#include "fake_keyring.h"
#include "fake_server.h"
#include "shared_data.h"
#include "small_series.h"
#include "test_desk.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <gmock/gmock.h>

#include <QComboBox>
#include <QDialogButtonBox>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QTest>
#include <QTreeWidget>
#include <cstdlib>

namespace ostia::workstation {
namespace {

using ostia::testing::FakeServer;
using ostia::testing::http_answer;
using ostia::testing::small_series;
using ostia::testing::SmallSeries;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::wait_until;

struct OutboxWindow : ::testing::Test {
  std::filesystem::path home = ostia::testing::temporary_folder("outbox-home");
  SmallSeries series = small_series("outbox", 2);
  enum class Answer { nothing, refusal, taken } answers = Answer::nothing;
  std::vector<std::string> asked;
  FakeServer web{[this](const std::string& request) { return answer(request); }};
  testing::TestDesk test{ostia::testing::temporary_folder("outbox-desk")};
  testing::FakeKeyring keyring;
  Outbox outbox{test.desk(), keyring};
  std::filesystem::path file = home / "ostia" / "pacs.json";

  OutboxWindow() { ::setenv("XDG_CONFIG_HOME", home.c_str(), 1); }
  ~OutboxWindow() override { ::unsetenv("XDG_CONFIG_HOME"); }
  std::string answer(const std::string& request) {
    asked.push_back(request);
    if (answers == Answer::nothing) return {};
    if (answers == Answer::refusal) return http_answer(409, "text/plain", "");
    return http_answer(200, "application/dicom+json", request.starts_with("POST") ? "{}" : "[]");
  }
  pacs::ServerDescription server() const {
    pacs::ServerDescription one;
    one.name = "hospital";
    one.transport = pacs::Transport::dicomweb;
    one.url = "http://127.0.0.1:" + std::to_string(web.port()) + "/dicom-web";
    one.login = pacs::Login::basic;
    one.user = "ostia";
    one.attempts = 1;
    return one;
  }
  void describe() {
    std::filesystem::create_directories(file.parent_path());
    pacs::write_servers(file, {server()});
  }
  void queue_one() {
    const std::filesystem::path object = home / "object.dcm";
    core::write_file(object, series.bytes.front());
    pacs::SendQueue queue(test.desk().state_folder / "outbox");
    queue.add(object, "hospital", "pdf");
  }
  template <class Widget>
  static Widget& part(QDialog& dialog, const char* name) {
    auto* found = dialog.findChild<Widget*>(name);
    if (!found) throw std::runtime_error(name);
    return *found;
  }
  static void click(QWidget& button) { QTest::mouseClick(&button, Qt::LeftButton); }
  static void type(QLineEdit& field, const QString& text) {
    QTest::mouseClick(&field, Qt::LeftButton);
    QTest::keyClick(&field, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(&field, text);
  }
};

TEST_F(OutboxWindow, WhatWaitsIsSentTriedAgainAndRemoved) {
  describe();
  queue_one();
  keyring.kept["hospital"] = "open sesame";
  test.show();
  OutboxDialog dialog(outbox, test.desk());
  dialog.show();
  auto& list = part<QTreeWidget>(dialog, "outbox_items");
  ASSERT_EQ(list.topLevelItemCount(), 1);
  EXPECT_EQ(list.topLevelItem(0)->text(0), "Report (PDF)");
  EXPECT_EQ(list.topLevelItem(0)->text(2), "waiting");
  click(part<QPushButton>(dialog, "outbox_send"));
  ASSERT_TRUE(test.idle());
  EXPECT_EQ(list.topLevelItem(0)->text(2), "waiting") << "the server says nothing";
  EXPECT_THAT(list.topLevelItem(0)->text(4).toStdString(), HasSubstr("hospital"));

  answers = Answer::refusal;
  click(part<QPushButton>(dialog, "outbox_send"));
  ASSERT_TRUE(test.idle());
  ASSERT_EQ(list.topLevelItem(0)->text(2), "refused");
  EXPECT_FALSE(part<QPushButton>(dialog, "outbox_send").isEnabled());
  EXPECT_FALSE(part<QPushButton>(dialog, "outbox_retry").isEnabled()) << "nothing is chosen";

  answers = Answer::taken;
  QTest::mouseClick(list.viewport(), Qt::LeftButton, {}, list.visualItemRect(list.topLevelItem(0)).center());
  click(part<QPushButton>(dialog, "outbox_retry"));
  ASSERT_TRUE(test.idle());
  EXPECT_EQ(list.topLevelItem(0)->text(2), "sent") << list.topLevelItem(0)->text(4).toStdString();
  EXPECT_THAT(asked.back(), HasSubstr("Authorization: Basic"));

  QTest::mouseClick(list.viewport(), Qt::LeftButton, {}, list.visualItemRect(list.topLevelItem(0)).center());
  click(part<QPushButton>(dialog, "outbox_remove"));
  EXPECT_EQ(list.topLevelItemCount(), 0);
  EXPECT_THAT(outbox.items(), IsEmpty());
}

TEST_F(OutboxWindow, AServerIsDescribedTriedAndKeptWithoutItsPassword) {
  answers = Answer::taken;
  test.show();
  ServersDialog dialog({}, keyring, test.desk(), file);
  dialog.show();
  click(part<QPushButton>(dialog, "servers_new"));
  type(part<QLineEdit>(dialog, "servers_name"), "hospital");
  EXPECT_EQ(part<QListWidget>(dialog, "servers_list").item(0)->text(), "hospital");
  auto& buttons = *dialog.findChild<QDialogButtonBox*>();
  click(*buttons.button(QDialogButtonBox::Save));
  EXPECT_TRUE(dialog.isVisible());
  EXPECT_THAT(part<QLabel>(dialog, "servers_said").text().toStdString(), HasSubstr("host"));
  EXPECT_FALSE(std::filesystem::exists(file));

  QTest::keyClick(&part<QComboBox>(dialog, "servers_transport"), Qt::Key_Down);
  EXPECT_FALSE(part<QLineEdit>(dialog, "servers_host").isVisible());
  type(part<QLineEdit>(dialog, "servers_url"), QString::fromStdString(server().url));
  QTest::keyClick(&part<QComboBox>(dialog, "servers_login"), Qt::Key_Down);
  type(part<QLineEdit>(dialog, "servers_user"), "ostia");
  type(part<QLineEdit>(dialog, "servers_password"), "open sesame");
  click(part<QPushButton>(dialog, "servers_test"));
  ASSERT_TRUE(test.idle());
  EXPECT_EQ(part<QLabel>(dialog, "servers_said").text(), "It answers, and lets us in.");
  click(*buttons.button(QDialogButtonBox::Save));
  EXPECT_FALSE(dialog.isVisible());
  const auto kept = pacs::read_servers(file);
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0].url, server().url);
  EXPECT_EQ(kept[0].user, "ostia");
  EXPECT_EQ(keyring.kept["hospital"], "open sesame");
  EXPECT_THAT(core::read_file(file), Not(HasSubstr("sesame")));
}

TEST_F(OutboxWindow, APasswordFollowsItsServerToAnotherNameAndGoesWithIt) {
  pacs::ServerDescription other = server();
  other.name = "practice";
  keyring.kept = {{"hospital", "open sesame"}, {"practice", "swordfish"}};
  test.show();
  const auto rename = [&](const std::vector<std::pair<int, const char*>>& names, int removed = -1) {
    ServersDialog dialog(pacs::read_servers(file), keyring, test.desk(), file);
    dialog.show();
    auto& list = part<QListWidget>(dialog, "servers_list");
    for (const auto& [row, name] : names) {
      list.setCurrentRow(row);
      type(part<QLineEdit>(dialog, "servers_name"), name);
    }
    if (removed >= 0) {
      list.setCurrentRow(removed);
      click(part<QPushButton>(dialog, "servers_remove"));
    }
    click(*dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Save));
    EXPECT_FALSE(dialog.isVisible());
  };
  using Kept = std::map<QString, QString>;
  std::filesystem::create_directories(file.parent_path());
  pacs::write_servers(file, {server(), other});
  rename({{0, "clinic"}});
  EXPECT_EQ(keyring.kept, (Kept{{"clinic", "open sesame"}, {"practice", "swordfish"}}));
  rename({{0, "practice"}, {1, "clinic"}});
  EXPECT_EQ(keyring.kept, (Kept{{"practice", "open sesame"}, {"clinic", "swordfish"}}));
  rename({}, 0);
  EXPECT_EQ(keyring.kept, (Kept{{"clinic", "swordfish"}}));
}

TEST_F(OutboxWindow, WithoutACaseNothingCanBeSentAndItIsSaidWhy) {
  EXPECT_EQ(outbox.why_not(), "No case is open.");
}

}  // namespace
}  // namespace ostia::workstation
