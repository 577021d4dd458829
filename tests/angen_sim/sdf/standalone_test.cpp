#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "sdf/load.h"

namespace angen::load {
namespace {

namespace fs = std::filesystem;

const std::string kStl =
    "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
    "vertex 0 1 0\nendloop\nendfacet\nendsolid s\n";

const std::string kPlate =
    "<sdf version='1.6'><model name='plate'><link name='l'><visual name='v'><geometry><mesh>"
    "<uri>plate.stl</uri></mesh></geometry></visual></link></model></sdf>";

const std::string kWorld = R"(<sdf version='1.5'><world name='home'>
  <gravity>0 0 -9.7</gravity>
  <include><uri>file://plate.sdf</uri><name>a</name><pose>1 2 0.1 0 0 0.3</pose></include>
  <model name='b'><pose relative_to='a'>0 0 1 0 0 0</pose><link name='l'/>
    <include><uri>file://plate.sdf</uri><name>inner</name></include></model>
  <state world_name='home'><model name='b'><pose>5 6 7 0 0 0</pose></model></state>
</world></sdf>)";

struct PlateFolder {
  PlateFolder() {
    fs::remove_all(path);
    fs::create_directories(path);
    write("plate.stl", kStl);
    write("plate.sdf", kPlate);
    write("home.world", kWorld);
  }
  ~PlateFolder() { fs::remove_all(path); }
  PlateFolder(const PlateFolder&) = delete;
  PlateFolder& operator=(const PlateFolder&) = delete;

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name) << text;
  }
  std::string at(const std::string& name) const { return (path / name).string(); }

  fs::path path = fs::path(testing::TempDir()) / "angen_standalone";
};

// A text has no folder: files that it may name besides those of the paths.
SearchPaths naming(const std::string& file) {
  SearchPaths paths;
  paths.files = {file};
  return paths;
}

TEST(Standalone, TheTextOfAWorldLoadsAsTheWorldDoes) {
  const PlateFolder folder;
  const std::string text = world_text(folder.at("home.world"));
  EXPECT_EQ(text.find("<include"), std::string::npos) << text;
  const desc::World from_file = world(folder.at("home.world"));
  fs::remove(folder.path / "plate.sdf");
  const desc::World from_text = world_from_text(text, "text", naming(folder.at("plate.stl")));
  ASSERT_EQ(from_text.models.size(), from_file.models.size());
  EXPECT_EQ(from_text.gravity, from_file.gravity);
  for (std::size_t i = 0; i < from_file.models.size(); ++i) {
    const desc::Model& one = from_text.models[i];
    const desc::Model& other = from_file.models[i];
    EXPECT_EQ(one.name, other.name);
    EXPECT_TRUE(one.pose == other.pose) << one.name;
    ASSERT_EQ(one.links.size(), other.links.size()) << one.name;
    for (std::size_t k = 0; k < one.links.size(); ++k) {
      EXPECT_EQ(one.links[k].name, other.links[k].name);
      EXPECT_TRUE(one.links[k].pose == other.links[k].pose) << one.links[k].name;
      EXPECT_EQ(one.links[k].visuals.size(), other.links[k].visuals.size());
    }
  }
  EXPECT_EQ(from_file.models[1].pose.position, Vec3(5, 6, 7)) << "of the <state>";
}

TEST(Standalone, TellsWhichFilesATextNeeds) {
  const PlateFolder folder;
  const std::string text = world_text(folder.at("home.world"));
  const std::vector<UsedFile> files = files_of(text, {});
  ASSERT_EQ(files.size(), 1U);
  EXPECT_EQ(files[0].uri, "file://" + folder.at("plate.stl"));
  EXPECT_EQ(files[0].path, folder.at("plate.stl"));
  fs::rename(folder.path / "plate.stl", folder.path / "moved.stl");
  EXPECT_EQ(files_of(text, {})[0].path, "");
  const std::vector<Diagnostic> warnings = world_from_text(text, "text", {}).warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const Diagnostic& each) {
    return each.message.find("plate.stl' is not found") != std::string::npos;
  }));
  const std::string moved = with_files(text, {{files[0].uri, folder.at("moved.stl")}});
  EXPECT_EQ(world_from_text(moved, "text", naming(folder.at("moved.stl"))).models.size(), 2U);
}

TEST(Standalone, AModelIsTheSameInAWorldAroundIt) {
  const PlateFolder folder;
  const Pose pose{{0.1, 0.2, 0.3}, from_rpy(0.1, 0.2, 1.0 / 3.0)};
  const desc::Model model = load::model(folder.at("plate.sdf"), "mine", pose, {});
  const desc::World around =
      world_from_text(world_around(model), "text", naming(folder.at("plate.stl")));
  ASSERT_EQ(around.models.size(), 1U);
  EXPECT_EQ(around.models[0].name, "mine");
  EXPECT_EQ(around.models[0].links.size(), model.links.size());
  EXPECT_LT((around.models[0].pose.position - pose.position).norm(), 1e-12);
}

}  // namespace
}  // namespace angen::load
