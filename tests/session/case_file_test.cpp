#include "case_file/case_open.h"
#include "case_tools.h"

#include "ostia/core/error.h"
#include "ostia/session/edit_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>
#include <cstdlib>

namespace ostia::session {
namespace {

using namespace testing;
using lumen::digest;
using ::testing::HasSubstr;

const std::string some_hash(64, 'a');

template <class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const Error& e) {
    return e.what();
  }
  return "nothing was thrown";
}

TEST(CaseFile, KeepsTheModelToTheLastBit) {
  const TempFolder folder;
  const lumen::LumenModel model = y_model();
  { EXPECT_EQ(digest(*CaseFile::create(folder / "a.ostia", model).model()), digest(model)); }
  const CaseFile opened = CaseFile::open(folder / "a.ostia");
  EXPECT_EQ(digest(*opened.model()), digest(model));
  EXPECT_EQ(digest(*opened.starting_model()), digest(model));
  ASSERT_EQ(opened.journal().size(), 1U);
  EXPECT_EQ(opened.journal()[0].op, "case.begin");
}

TEST(CaseFile, ClosedItIsOneFile) {
  const TempFolder folder;
  {
    CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
    file.apply(ring(10.0, 1.8));
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST(CaseFile, DoesNotReplaceAFile) {
  const TempFolder folder;
  write_bytes(folder / "a.ostia", "precious");
  EXPECT_THROW(CaseFile::create(folder / "a.ostia", tube_model()), IoError);
  EXPECT_EQ(bytes_of_file(folder / "a.ostia"), "precious");
  EXPECT_THROW(CaseFile::create(folder / "a.ostia" / "b.ostia", tube_model()), IoError);
  EXPECT_THROW(CaseFile::create(folder / "b.ostia", lumen::LumenModel{tube_model().tree, {}, {}, 1, 1}),
               InvalidInput);
  EXPECT_FALSE(fs::exists(folder / "b.ostia"));
}

TEST(CaseFile, UndoAndRedoGiveTheSameBitsAndSurviveARestart) {
  const TempFolder folder;
  std::vector<std::string> digests;
  {
    CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
    digests.push_back(digest(*file.model()));
    for (const lumen::Edit& edit :
         {lumen::Edit(ring(10.0, 1.8)), lumen::Edit(drag(20.0, 0.3)), lumen::Edit(renamed("LAD prox")),
          lumen::Edit(lumen::AxisMove{tube_vessel, {0, 0, 15}, {0.4, 0, 15}, 5.0})}) {
      file.apply(edit);
      digests.push_back(digest(*file.model()));
    }
  }
  for (std::size_t i = digests.size() - 1; i-- > 0;) {
    CaseFile file = CaseFile::open(folder / "a.ostia");
    ASSERT_TRUE(file.undo());
    EXPECT_EQ(digest(*file.model()), digests[i]);
  }
  CaseFile::open(folder / "a.ostia").undo();  // nothing left
  for (std::size_t i = 1; i < digests.size(); ++i) {
    CaseFile file = CaseFile::open(folder / "a.ostia");
    ASSERT_TRUE(file.redo());
    EXPECT_EQ(digest(*file.model()), digests[i]);
  }
  EXPECT_FALSE(CaseFile::open(folder / "a.ostia").redo());
}

TEST(CaseFile, UndoBringsBackADeletedBranch) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", y_model());
  const std::string before = digest(*file.model());
  const std::int32_t vessel = file.model()->vessels.back()->vessel;
  file.apply(lumen::BranchDelete{vessel});
  const std::string without = digest(*file.model());
  const auto undone = file.undo();
  ASSERT_TRUE(undone);
  EXPECT_EQ(digest(*file.model()), before);
  EXPECT_TRUE(std::any_of(undone->edit.changes.begin(), undone->edit.changes.end(), [&](const auto& change) {
    return change.vessel == vessel && change.axis_changed && !change.added.empty();
  }));
  ASSERT_TRUE(file.redo());
  EXPECT_EQ(digest(*file.model()), without);
}

TEST(CaseFile, UndoSharesTheVesselsItDidNotTouch) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", y_model());
  const std::int32_t vessel = file.model()->vessels.front()->vessel;
  file.apply(lumen::VesselRename{vessel, "other"});
  const auto edited = file.model();
  file.undo();
  EXPECT_EQ(file.model()->vessels.back(), edited->vessels.back());
}

TEST(CaseFile, AnotherEditDropsTheRedo) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
  file.apply(renamed("one"));
  file.apply(renamed("two"));
  file.undo();
  file.apply(renamed("three"));
  EXPECT_FALSE(file.redo());
  const auto edits = file.edits();
  ASSERT_EQ(edits.size(), 2U);
  EXPECT_EQ(std::get<lumen::VesselRename>(edits[1]).name, "three");
  file.undo();
  file.undo();
  EXPECT_FALSE(file.undo());
  EXPECT_EQ(digest(*file.model()), digest(tube_model()));
  // The journal forgets nothing: begin, one, two, undo, three, undo, undo.
  EXPECT_EQ(file.journal().size(), 7U);
}

TEST(CaseFile, ADragIsOneStep) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
  for (const double by : {0.1, 0.2, 0.35}) file.apply_merged(drag(15.0, by));
  EXPECT_EQ(digest(*file.model()), digest(lumen::apply(tube_model(), drag(15.0, 0.35)).model));
  ASSERT_EQ(file.edits().size(), 1U);
  EXPECT_EQ(to_json(file.edits()[0]), to_json(drag(15.0, 0.35)));
  const std::string merged = digest(*file.model());
  file.undo();
  EXPECT_EQ(digest(*file.model()), digest(tube_model()));
  file.redo();
  EXPECT_EQ(digest(*file.model()), merged);
  file.apply_merged(drag(10.0, 0.2));  // another place: a step of its own
  EXPECT_EQ(file.edits().size(), 2U);
}

TEST(CaseFile, MergesOnlyWhatContinues) {
  EXPECT_TRUE(mergeable(drag(1, 0.1), drag(1, 0.2)));
  EXPECT_FALSE(mergeable(drag(1, 0.1), drag(2, 0.1)));
  EXPECT_FALSE(mergeable(drag(1, 0.1), renamed("x")));
  EXPECT_FALSE(mergeable(ring(1, 1), ring(1, 1)));
  const geometry::Vec3 a(0, 0, 1), b(0, 0, 2);
  EXPECT_TRUE(mergeable(lumen::WallPush{1, {a}, 1}, lumen::WallPush{1, {a, b}, 1}));
  EXPECT_FALSE(mergeable(lumen::WallPush{1, {a, b}, 1}, lumen::WallPush{1, {b, a}, 1}));
}

TEST(CaseFile, ARefusedEditChangesNothing) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
  file.apply(renamed("one"));
  file.undo();
  const std::string before = digest(*file.model());
  EXPECT_THROW(file.apply(lumen::VesselRename{99, "none"}), InvalidInput);
  const auto refuse = [](const lumen::EditOutcome&) { throw NumericalError("cannot be solved"); };
  EXPECT_THROW(file.apply(ring(10.0, 1.8), refuse), NumericalError);
  EXPECT_THROW(file.apply_merged(drag(15.0, 0.2), refuse), NumericalError);
  EXPECT_THROW(file.redo(refuse), NumericalError);
  EXPECT_EQ(digest(*file.model()), before);
  EXPECT_EQ(file.journal().size(), 3U);
  EXPECT_TRUE(file.redo());  // the step to redo is still there
  EXPECT_THROW(file.undo(refuse), NumericalError);
  EXPECT_EQ(file.model()->tree.vessels[0].name, "one");
}

TEST(CaseFile, ACopyHasTheJournalToo) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", tube_model(), ImageReference{some_hash, "case-3f2a"});
  file.apply(ring(10.0, 1.8));
  file.apply(renamed("one"));
  file.undo();
  file.copy_to(folder / "b.ostia");  // from a file with a WAL
  EXPECT_THROW(file.copy_to(folder / "b.ostia"), IoError);
  CaseFile::open(folder / "b.ostia", OpenMode::read_only).copy_to(folder / "c.ostia");  // from memory
  for (const char* name : {"b.ostia", "c.ostia"}) {
    CaseFile copy = CaseFile::open(folder / name);
    EXPECT_EQ(digest(*copy.model()), digest(*file.model()));
    EXPECT_EQ(digest(*copy.starting_model()), digest(tube_model()));
    EXPECT_EQ(copy.journal().size(), 4U);
    EXPECT_EQ(copy.image()->pseudonym, "case-3f2a");
    EXPECT_TRUE(copy.redo());
    EXPECT_EQ(copy.model()->tree.vessels[0].name, "one");
  }
  EXPECT_EQ(file.model()->tree.vessels[0].name, "LAD");
}

TEST(CaseFile, KnowsItsImage) {
  const TempFolder folder;
  { CaseFile::create(folder / "a.ostia", tube_model(), ImageReference{some_hash, "case-3f2a"}); }
  const CaseFile file = CaseFile::open(folder / "a.ostia");
  ASSERT_TRUE(file.image());
  EXPECT_EQ(file.image()->pseudonym, "case-3f2a");
  EXPECT_NO_THROW(file.check_image({some_hash, "another name"}));
  EXPECT_THAT(message_of([&] { file.check_image({std::string(64, 'b'), "x"}); }), HasSubstr("case-3f2a"));
  EXPECT_THROW(CaseFile::create(folder / "b.ostia", tube_model(), ImageReference{"short", "x"}),
               InvalidInput);
}

TEST(CaseFile, KeepsSettingsButNoPaths) {
  const TempFolder folder;
  {
    CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
    file.set_setting("window", "700/300");
    file.set_setting("window", "800/300");
    EXPECT_THROW(file.set_setting("last", "/home/someone/x.nrrd"), InvalidInput);
    EXPECT_THROW(file.set_setting("last", "C:\\x.nrrd"), InvalidInput);
  }
  const CaseFile file = CaseFile::open(folder / "a.ostia");
  EXPECT_EQ(file.setting("window"), "800/300");
  EXPECT_FALSE(file.setting("last"));
}

TEST(CaseFile, HoldsNoPathOrName) {
  const TempFolder folder;
  const fs::path place = folder / "DOE^JANE";
  fs::create_directory(place);
  const fs::path path = place / "DOE^JANE 1970.ostia";
  CaseFile file = CaseFile::create(path, tube_model(), ImageReference{some_hash, "case-3f2a"});
  file.apply(ring(10.0, 1.8));
  file.undo();
  const auto holds = [](const fs::path& of) {
    return bytes_of_file(of).find("DOE^JANE") != std::string::npos;
  };
  for (const auto& entry : fs::directory_iterator(place)) EXPECT_FALSE(holds(entry.path())) << entry.path();
  file = CaseFile::create(place / "other.ostia", tube_model());  // closes the first
  for (const auto& entry : fs::directory_iterator(place)) EXPECT_FALSE(holds(entry.path())) << entry.path();
}

TEST(CaseFile, OneWriterAtATime) {
  const TempFolder folder;
  const CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
  ::setenv("OSTIA_TEST_CASE", (folder / "a.ostia").c_str(), 1);
  EXPECT_THAT(message_of([&] { CaseFile::open(folder / "a.ostia"); }), HasSubstr("another window"));
  EXPECT_THROW(CaseFile::open(folder / "a.ostia", OpenMode::read_only), IoError);
  for (const OpenMode mode : {OpenMode::read_write, OpenMode::read_only}) {
    const pid_t child = ::fork();
    if (child == 0) {
      // The mark of open files is this process's; another program has none.
      ::execl("/proc/self/exe", "test", "--gtest_also_run_disabled_tests",
              mode == OpenMode::read_only ? "--gtest_filter=CaseFile.DISABLED_OpensForReading"
                                          : "--gtest_filter=CaseFile.DISABLED_OpensForEditing",
              "--gtest_brief=1", static_cast<char*>(nullptr));
      ::_exit(99);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(WEXITSTATUS(status), 0);
  }
}

// Run by OneWriterAtATime as another process; without its variable there is nothing to open.
void open_elsewhere(OpenMode mode) {
  const char* path = std::getenv("OSTIA_TEST_CASE");
  ASSERT_NE(path, nullptr);
  EXPECT_THAT(message_of([&] { CaseFile::open(path, mode); }), HasSubstr("another window or program"));
}
TEST(CaseFile, DISABLED_OpensForEditing) {
  open_elsewhere(OpenMode::read_write);
}
TEST(CaseFile, DISABLED_OpensForReading) {
  open_elsewhere(OpenMode::read_only);
}

TEST(CaseFile, ReadOnlyLeavesTheFileAlone) {
  const TempFolder folder;
  {
    CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
    file.apply(renamed("one"));
  }
  const std::string bytes = bytes_of_file(folder / "a.ostia");
  {
    CaseFile file = CaseFile::open(folder / "a.ostia", OpenMode::read_only);
    EXPECT_EQ(file.edits().size(), 1U);
    EXPECT_THROW(file.apply(renamed("two")), IoError);
    EXPECT_THROW(file.undo(), IoError);
    EXPECT_THROW(file.set_setting("a", "b"), IoError);
    EXPECT_EQ(file.model()->tree.vessels[0].name, "one");
    const CaseFile second = CaseFile::open(folder / "a.ostia", OpenMode::read_only);
  }
  EXPECT_EQ(bytes_of_file(folder / "a.ostia"), bytes);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

/// Runs in a child as a user without special rights; its result is the child's exit status.
template <class Body>
int as_nobody(const Body& body) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (::geteuid() == 0 && ::seteuid(65534) != 0) ::_exit(98);
    ::_exit(body());
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 97;
}

TEST(CaseFile, AReadOnlyFileOrFolderIsRefusedForEditing) {
  const TempFolder folder;
  { CaseFile::create(folder / "a.ostia", tube_model()); }
  const auto tried = [&] {
    const std::string refusal = message_of([&] { CaseFile::open(folder / "a.ostia"); });
    if (refusal.find("read-only") == std::string::npos) return 1;
    try {
      return CaseFile::open(folder / "a.ostia", OpenMode::read_only).journal().size() == 1 ? 0 : 2;
    } catch (const std::exception&) {
      return 3;
    }
  };
  fs::permissions(folder.path(), fs::perms(0777));
  fs::permissions(folder / "a.ostia", fs::perms(0444));
  EXPECT_EQ(as_nobody(tried), 0);
  fs::permissions(folder / "a.ostia", fs::perms(0666));
  fs::permissions(folder.path(), fs::perms(0555));
  EXPECT_EQ(as_nobody(tried), 0);
  fs::permissions(folder.path(), fs::perms(0755));
}

TEST(CaseFile, AFullDiskKeepsTheOldState) {
  const TempFolder folder;
  { CaseFile::create(folder / "a.ostia", tube_model()); }
  const auto tried = [&] {
    std::signal(SIGXFSZ, SIG_IGN);
    CaseFile file = CaseFile::open(folder / "a.ostia");
    file.apply(renamed("one"));
    const std::string before = digest(*file.model());
    rlimit limit{};
    ::getrlimit(RLIMIT_FSIZE, &limit);
    limit.rlim_cur = 4096;  // less than the next commit needs
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      file.apply(ring(10.0, 1.8));
      return 1;
    } catch (const ResourceError&) {
    } catch (const std::exception& e) {
      ADD_FAILURE() << e.what();
      return 2;
    }
    if (digest(*file.model()) != before || file.journal().size() != 2) return 3;
    limit.rlim_cur = limit.rlim_max;
    ::setrlimit(RLIMIT_FSIZE, &limit);
    file.apply(ring(10.0, 1.8));  // there is room again
    return 0;
  };
  const pid_t child = ::fork();
  if (child == 0) ::_exit(tried());
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(CaseFile::open(folder / "a.ostia").edits().size(), 2U);
}

TEST(CaseFile, NetworkFileSystemsGetARollbackJournal) {
  EXPECT_TRUE(is_network_file_system(0x6969));
  EXPECT_TRUE(is_network_file_system(0xFF534D42));
  EXPECT_FALSE(is_network_file_system(0xEF53));  // ext4
  const TempFolder folder;
  { CaseFile::create(folder / "a.ostia", tube_model()); }
  for (const auto& [kind, name] :
       {std::pair(JournalKind::rollback, "truncate"), std::pair(JournalKind::wal, "wal")}) {
    OpenedCase opened = open_case(folder / "a.ostia", OpenMode::read_write);
    configure(opened.database, kind);
    EXPECT_EQ(opened.database.text_of("PRAGMA journal_mode"), name);
    EXPECT_EQ(opened.database.text_of("PRAGMA synchronous"), "2");
    EXPECT_EQ(opened.database.text_of("PRAGMA locking_mode"), "exclusive");
  }
}

TEST(CaseSteps, HaveATimeAndTheNameThatWasGivenAlone) {
  const TempFolder folder;
  const char* user = std::getenv("USER");
  const std::string before = user ? user : "";
  ::setenv("USER", "account-of-the-system", 1);
  ::setenv("SOURCE_DATE_EPOCH", "1767225600", 1);
  {
    CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
    file.apply(ring(10.0, 1.8));
    file.set_author("Dr. A");
    file.apply(renamed("two"));
    EXPECT_THROW(file.set_author("a\nb"), InvalidInput);
    EXPECT_THROW(file.set_author(std::string(201, 'a')), InvalidInput);
  }
  ::unsetenv("SOURCE_DATE_EPOCH");
  user ? ::setenv("USER", before.c_str(), 1) : ::unsetenv("USER");
  CaseFile file = CaseFile::open(folder / "a.ostia");
  file.undo();
  const std::vector<JournalEntry> journal = file.journal();
  ASSERT_EQ(journal.size(), 4U);
  EXPECT_EQ(journal[1].author, "");
  EXPECT_EQ(journal[2].author, "Dr. A");
  EXPECT_EQ(journal[2].time_s, 1767225600);
  EXPECT_NE(journal[3].time_s, 1767225600);
  EXPECT_EQ(journal[3].author, "") << "a name is of this session, not of the case";
  EXPECT_EQ(bytes_of_file(folder / "a.ostia").find("account-of-the-system"), std::string::npos);
}

TEST(CaseSteps, ATimeThatWasChangedIsDamage) {
  const TempFolder folder;
  { CaseFile::create(folder / "a.ostia", tube_model()).apply(ring(10.0, 1.8)); }
  Database((folder / "a.ostia").string(), SQLITE_OPEN_READWRITE, "")
      .execute("UPDATE step_stamp SET time_s = 1");
  EXPECT_THROW(CaseFile::open(folder / "a.ostia"), InvalidInput);
}

}  // namespace
}  // namespace ostia::session
