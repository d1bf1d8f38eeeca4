#include "io_test_support.h"

#include "ostia/io/surface_file.h"

namespace ostia::io {
namespace {

TEST(Obj, ReadsFacesWithAllKindsOfCorners) {
  const auto loaded = read_surface(file_with("a.obj",
                                             "# a comment\nv 0 0 0\nv 1.5 0 0\r\nv 0 1 0\nv 0 0 1\nvn 0 0 "
                                             "1\nf 1 2 3\nf 1/4/1 2//1 4/2\nf -4 -3 -2 -1\n"));
  const auto& mesh = loaded.surface.mesh;
  ASSERT_EQ(mesh.points.size(), 4u);
  EXPECT_EQ(mesh.points[1].x(), 1.5);
  const std::vector<geometry::Triangle> expected{{0, 1, 2}, {0, 1, 3}, {0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(mesh.triangles, expected);
  EXPECT_EQ(loaded.warnings.size(), 1u);
}

TEST(Obj, RefusesNonsense) {
  const std::vector<std::pair<std::string, std::string>> bad{{"v 0 0\n", "no number"},
                                                             {"v 0 0 0\nf 1 2 3\n", "names point"},
                                                             {"v 0 0 0\nf 0 1 1\n", "no vertex"},
                                                             {"v 0 0 0\nf 1 1\n", "fewer"},
                                                             {"v 0 0 0\nf -2 1 1\n", "out of range"},
                                                             {"v 0 0 0\n", "no triangles"}};
  for (const auto& [content, part] : bad) {
    const auto path = file_with("a.obj", content);
    expect_refusal(path, [&] { read_surface(path); }, {part});
  }
}

TEST(Obj, GroupsAreFaces) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const auto read =
      read_surface(
          file_with("a.obj", points + "g wall\nf 1 3 2\ng  LAD \r\nf 1 2 4\ng wall\nf 1 4 3\ng\nf 2 3 4\n"))
          .surface;
  EXPECT_EQ(read.face_ids, (std::vector<std::int32_t>{1, 2, 1, 3}));
  ASSERT_EQ(read.faces.size(), 3u);
  EXPECT_EQ(read.faces[0].name, "wall");
  EXPECT_EQ(read.faces[1].name, "LAD");
  EXPECT_EQ(read.faces[2].name, "face_3");
  const auto one = read_surface(file_with("b.obj", points + "g all\nf 1 3 2\nf 1 2 4\n")).surface;
  EXPECT_TRUE(one.face_ids.empty()) << "one group says nothing";
  EXPECT_TRUE(one.faces.empty());
}

}  // namespace
}  // namespace ostia::io
