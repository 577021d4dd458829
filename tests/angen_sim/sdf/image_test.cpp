#include <algorithm>

#include "angen_sim/assets/pngs.h"

namespace angen::load {
namespace {

/// A picture drawn with '#' for black and anything else for white.
std::string picture(const Folder& folder, const std::vector<std::string>& rows) {
  std::vector<unsigned> samples;
  for (const std::string& row : rows) {
    for (const char c : row) samples.push_back(c == '#' ? 0 : 255);
  }
  return png(folder, static_cast<unsigned>(rows[0].size()), static_cast<unsigned>(rows.size()),
             samples);
}

std::string with_image(const std::string& more = "") {
  const std::string geometry =
      "<geometry>\n<image><uri>model://h.png</uri>" + more + "</image></geometry>";
  return in_link("<collision name='c'>" + geometry + "</collision><visual name='v'>" + geometry +
                 "</visual>");
}

std::vector<desc::Collision> boxes(const Folder& folder, const std::string& more = "") {
  return read(with_image(more), folder.paths()).models.at(0).links.at(0).collisions;
}

/// Whether a point is in one of the boxes.
bool solid(const std::vector<desc::Collision>& all, const Vec3& point) {
  return std::any_of(all.begin(), all.end(), [&](const desc::Collision& box) {
    return ((point - box.pose.position).cwiseAbs() - 0.5 * box.shape.size).maxCoeff() < 0.0;
  });
}

TEST(Image, IsBoxesWhereItIsDark) {
  const Folder folder;
  const std::vector<std::string> rows = {"##########", "#........#", "#..####..#", "#..####...",
                                         "##########"};
  picture(folder, rows);
  const auto all = boxes(folder, "<scale>0.5</scale><height>2.5</height>");
  for (std::size_t y = 0; y < rows.size(); ++y) {
    for (std::size_t x = 0; x < rows[y].size(); ++x) {
      const Vec3 middle{0.5 * (static_cast<double>(x) + 0.5 - 5.0),
                        0.5 * (2.5 - 0.5 - static_cast<double>(y)), 1.25};
      EXPECT_EQ(solid(all, middle), rows[y][x] == '#') << x << ", " << y;
      EXPECT_FALSE(solid(all, middle + Vec3(0, 0, 1.3)));
    }
  }
}

TEST(Image, IsFewBoxesThatDoNotOverlap) {
  const Folder folder;
  picture(folder,
          {"##########", "#........#", "#..####..#", "#..####..#", "#........#", "##########"});
  const auto all = boxes(folder);
  EXPECT_EQ(all.size(), 5U);  // four walls and a block
  double volume = 0.0;
  for (const desc::Collision& box : all) {
    EXPECT_EQ(box.shape.type, Shape::Type::kBox);
    volume += box.shape.size.prod();
  }
  EXPECT_DOUBLE_EQ(volume, 10 + 10 + 4 + 4 + 8);
}

TEST(Image, SeveralBoxesAreNumberedOneHasTheName) {
  const Folder folder;
  picture(folder, {"#.#"});
  const desc::Link link = read(with_image(), folder.paths()).models[0].links[0];
  ASSERT_EQ(link.collisions.size(), 2U);
  EXPECT_EQ(link.collisions[0].name, "c_0");
  EXPECT_EQ(link.collisions[1].name, "c_1");
  EXPECT_EQ(link.visuals.at(1).name, "v_1");
  EXPECT_EQ(link.visuals[0].pose.position, link.collisions[0].pose.position);
  picture(folder, {"##."});
  EXPECT_EQ(boxes(folder).at(0).name, "c");
}

TEST(Image, StandsWhereItsCollisionDoes) {
  const Folder folder;
  picture(folder, {"##"});
  const desc::Link link =
      read(in_link("<collision name='c'><pose>1 2 3 0 0 1.5707963267948966</pose><geometry><image>"
                   "<uri>model://h.png</uri></image></geometry></collision>"),
           folder.paths())
          .models[0]
          .links[0];
  expect_near(link.collisions.at(0).pose,
              {{1.0, 2.0, 3.5}, from_rpy(0.0, 0.0, 1.5707963267948966)});
}

TEST(Image, ThresholdIsTheLightestGrayThatIsSolid) {
  const Folder folder;
  png(folder, 4, 1, {0, 200, 201, 255});
  EXPECT_DOUBLE_EQ(boxes(folder).at(0).shape.size.x(), 2.0);
  EXPECT_DOUBLE_EQ(boxes(folder, "<threshold>199</threshold>").at(0).shape.size.x(), 1.0);
  EXPECT_DOUBLE_EQ(boxes(folder, "<threshold>255</threshold>").at(0).shape.size.x(), 4.0);
}

TEST(Image, GranularityTakesBlocksOfPixels) {
  const Folder folder;
  picture(folder, {"#.#.#.#", ".#.#.##", "....#..", "......."});
  EXPECT_GT(boxes(folder).size(), 5U);
  const auto all = boxes(folder, "<granularity>2</granularity>");
  ASSERT_EQ(all.size(), 1U);  // half of each block above is dark, less of those below
  EXPECT_DOUBLE_EQ(all[0].shape.size.x(), 7.0);
  EXPECT_DOUBLE_EQ(all[0].shape.size.y(), 2.0);
  expect_near(all[0].pose.position, {0.0, 1.0, 0.5});
}

TEST(Image, WhatIsWrongIsSaid) {
  const Folder folder;
  const auto error = [&](const std::string& more = "") {
    return error_of(with_image(more), folder.paths());
  };
  EXPECT_NE(error().find("w.world:2: image 'model://h.png' is not found"), std::string::npos)
      << error();
  folder.write("h.png", "not a png");
  EXPECT_NE(error().find("cannot be read"), std::string::npos) << error();
  picture(folder, {"...", "..."});
  EXPECT_NE(error().find("as dark as the <threshold> 200"), std::string::npos) << error();
  picture(folder, {"#"});
  EXPECT_NE(error("<threshold>300</threshold>").find("<threshold> is 300; it must be 0, black"),
            std::string::npos);
  EXPECT_NE(error("<granularity>1.5</granularity>").find("whole number"), std::string::npos);
  EXPECT_NE(error("<scale>0</scale>").find("greater than 0"), std::string::npos);
  EXPECT_NE(error("<height>-1</height>").find("greater than 0"), std::string::npos);
  std::vector<unsigned> samples;
  for (unsigned i = 0; i < 50 * 50; ++i) samples.push_back((i + i / 50) % 2 * 255);
  png(folder, 50, 50, samples);
  EXPECT_NE(error().find("gives 1250 boxes, more than 1000"), std::string::npos) << error();
  EXPECT_NE(error_of(in_link("<collision name='c'><geometry><image/></geometry></collision>"))
                .find("<image> has no <uri>"),
            std::string::npos);
}

}  // namespace
}  // namespace angen::load
