// What other tests read instead of scanning a patient anew is that scan.
#include "kept_scan.h"

#include "shared_data.h"

#include "ostia/core/files.h"

#include <gtest/gtest.h>

namespace ostia::phantom {
namespace {

namespace fs = std::filesystem;

CasePlan small_field() {
  CaseOptions options;
  options.preset = Preset::tiny;
  CasePlan plan = plan_case(options);
  plan.options.scan.grid.size = {24, 20, 16};
  return plan;
}

void expect_same(const Scan& a, const Scan& b) {
  EXPECT_EQ(a.image.voxels, b.image.voxels);
  EXPECT_EQ(a.labels.voxels, b.labels.voxels);
  EXPECT_EQ(a.image.geometry.size, b.image.geometry.size);
  EXPECT_TRUE(imaging::same_grid(a.image.geometry, b.image.geometry, 0.0));
  EXPECT_TRUE(imaging::same_grid(a.labels.geometry, b.labels.geometry, 0.0));
}

std::vector<fs::path> scans_in(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const fs::directory_entry& one : fs::directory_iterator(folder))
    if (one.path().extension() == ".scan") found.push_back(one.path());
  return found;
}

TEST(KeptScan, IsTheScanAndIsMadeOnce) {
  const fs::path folder = ostia::testing::temporary_folder("scans");
  const CasePlan plan = small_field();
  const Scan truth = scan_case(plan);
  expect_same(ostia::testing::kept_scan(plan, folder), truth);
  const std::vector<fs::path> files = scans_in(folder);
  ASSERT_EQ(files.size(), 1U);
  const auto made = fs::last_write_time(files[0]);
  expect_same(ostia::testing::kept_scan(plan, folder), truth);
  EXPECT_EQ(fs::last_write_time(files[0]), made);
}

TEST(KeptScan, OtherOptionsAreAnotherScan) {
  const fs::path folder = ostia::testing::temporary_folder("scans");
  CasePlan plan = small_field();
  const Scan first = ostia::testing::kept_scan(plan, folder);
  plan.options.scan.grid.origin.x() += 0.125;
  expect_same(ostia::testing::kept_scan(plan, folder), scan_case(plan));
  plan.options.scan.noise_hu += 1.0;
  const Scan last = ostia::testing::kept_scan(plan, folder);
  expect_same(last, scan_case(plan));
  EXPECT_NE(first.image.voxels, last.image.voxels);
  EXPECT_EQ(scans_in(folder).size(), 3U);
}

TEST(KeptScan, AFileThatIsCutOffOrOfOtherLibrariesIsMadeAnew) {
  const fs::path folder = ostia::testing::temporary_folder("scans");
  const CasePlan plan = small_field();
  const Scan truth = ostia::testing::kept_scan(plan, folder);
  const fs::path file = scans_in(folder).at(0);
  const std::string whole = core::read_file(file);
  std::string other = whole;
  other[0] = other[0] == '1' ? '2' : '1';  // the first library's size
  other.back() = static_cast<char>(other.back() + 1);
  for (const std::string& wrong : {whole.substr(0, whole.size() - 1), std::string(), other}) {
    core::write_file(file, wrong);
    expect_same(ostia::testing::kept_scan(plan, folder), truth);
    EXPECT_EQ(core::read_file(file), whole);
  }
}

}  // namespace
}  // namespace ostia::phantom
