#include "angen_sim/assets/pngs.h"
#include "assets/mesh.h"
#include "sdf/geometry.h"

namespace angen::load {
namespace {

using Format = PngFormat;

/// A square one.
std::string png(const Folder& folder, unsigned side, const std::vector<unsigned>& samples,
                const Format& format = {}) {
  return png(folder, side, side, samples, format);
}

float first_height(const std::string& file) {
  return read_heightmap(file, Vec3::Ones(), {})->heights.at(0);
}

TEST(Heightmap, HasTheFilesValuesOf8And16Bits) {
  const Folder folder;
  for (const Format::Gamma gamma :
       {Format::Gamma::kNone, Format::Gamma::kGama, Format::Gamma::kSrgb}) {
    EXPECT_FLOAT_EQ(first_height(png(folder, 2, {128, 0, 0, 255}, {8, PNG_COLOR_TYPE_GRAY, gamma})),
                    128.0F / 255.0F);
    const Format format{16, PNG_COLOR_TYPE_GRAY, gamma};
    EXPECT_FLOAT_EQ(first_height(png(folder, 2, {0x8000, 0, 0, 65535}, format)),
                    32768.0F / 65535.0F);
    EXPECT_FLOAT_EQ(first_height(png(folder, 2, {1, 0, 0, 65535}, format)), 1.0F / 65535.0F);
  }
}

TEST(Heightmap, OfAColorImageIsTheMeanWhateverItsAlpha) {
  const Folder folder;
  const Format rgb{8, PNG_COLOR_TYPE_RGB};
  EXPECT_FLOAT_EQ(first_height(png(folder, 2, {10, 20, 60, 0, 0, 0, 0, 0, 0, 0, 0, 0}, rgb)),
                  30.0F / 255.0F);
  const Format alpha{8, PNG_COLOR_TYPE_GRAY_ALPHA};
  EXPECT_FLOAT_EQ(first_height(png(folder, 2, {51, 7, 0, 0, 0, 0, 0, 0}, alpha)), 0.2F);
}

TEST(Heightmap, SpansItsSizeAndRisesWithGray) {
  const Folder folder;
  const std::string file = png(folder, 3, {255, 0, 0, 0, 0, 0, 0, 0, 51});
  const auto grid = read_heightmap(file, {4.0, 6.0, 10.0}, {});
  EXPECT_LT((grid->vertex(0, 0) - Eigen::Vector3f(-2, 3, 10)).norm(), 1e-5);
  EXPECT_LT((grid->vertex(2, 2) - Eigen::Vector3f(2, -3, 2)).norm(), 1e-5);
  EXPECT_EQ(grid->triangle_of(1, 1) + 2, 8U);
  for (std::uint32_t i = 0; i < 8; ++i) {
    const HeightGrid::Triangle t = grid->triangle(i);
    const Eigen::Vector3f a = grid->vertex(t[0].column, t[0].row);
    const Eigen::Vector3f b = grid->vertex(t[1].column, t[1].row);
    const Eigen::Vector3f c = grid->vertex(t[2].column, t[2].row);
    EXPECT_GT((b - a).cross(c - a).z(), 0.0F);
  }
}

TEST(Heightmap, IsKeptWhileItIsUsed) {
  const Folder folder;
  const std::string file = png(folder, 2, {1, 2, 3, 4});
  const auto first = read_heightmap(file, Vec3::Ones(), {});
  EXPECT_EQ(read_heightmap(file, Vec3::Ones(), {}), first);
  EXPECT_NE(read_heightmap(file, 2 * Vec3::Ones(), {}), first);
}

TEST(Heightmap, StandsWhereItsPosSays) {
  const Folder folder;
  png(folder, 2, {0, 0, 0, 0});
  const desc::Collision c =
      read(in_link("<collision name='c'><geometry><heightmap><uri>model://h.png</uri><size>1 1 1"
                   "</size><pos>0 0 5</pos></heightmap></geometry></collision>"),
           folder.paths())
          .models[0]
          .links[0]
          .collisions[0];
  EXPECT_EQ(c.shape.type, Shape::Type::kHeightmap);
  EXPECT_TRUE(c.shape.mesh_file.empty());
  expect_near(c.pose.position, {0.0, 0.0, 5.0});
}

TEST(Heightmap, NoImageIsAnError) {
  const Folder folder;
  EXPECT_THROW(read_heightmap(folder.write("h.png", "not a png"), Vec3::Ones(), {}), Error);
  EXPECT_THROW(read_heightmap(folder.path() + "/none.png", Vec3::Ones(), {}), Error);
  EXPECT_THROW(read_heightmap(png(folder, 1, {0}), Vec3::Ones(), {}), Error);
}

TEST(Heightmap, ThatIsCutOffIsAnError) {
  const Folder folder;
  const std::string file = png(folder, 64, std::vector<unsigned>(64 * 64, 3));
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_THROW(read_heightmap(file, Vec3::Ones(), {}), Error);
}

}  // namespace
}  // namespace angen::load
