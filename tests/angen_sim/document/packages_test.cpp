#include "document/packages.h"

#include <gtest/gtest.h>

#include "angen_sim/sdf/texts.h"

namespace angen::load {
namespace {

const char* const kModel = "<sdf version='1.6'><model name='m'><link name='l'/></model></sdf>";

struct Workspace : Folder {
  Workspace() {
    write("meta/bot_description/package.xml", "<package><name>bot_description</name></package>");
    write("meta/bot_description/sdf/model.sdf", kModel);
    write("meta/bot_gazebo/package.xml",
          "<package><name>bot_gazebo</name><export><gazebo_ros "
          "gazebo_model_path='${prefix}/models'/></export></package>");
    write("meta/bot_gazebo/models/hall/model.sdf", kModel);
    write("ignored/CATKIN_IGNORE", "");
    write("ignored/bot/package.xml", "<package><name>bot</name></package>");
  }
  SearchPaths with_packages() const {
    SearchPaths paths;
    paths.packages = {path()};
    return paths;
  }
};

std::size_t models_of(const std::string& uri, const SearchPaths& paths) {
  return read(in_world("<include><uri>" + uri + "</uri></include>"), paths).models.size();
}

TEST(Packages, AreFoundByNameSomeFoldersDeep) {
  const Workspace workspace;
  const Packages packages({workspace.path()});
  EXPECT_EQ(packages.folder("bot_description"), workspace.path() + "/meta/bot_description");
  EXPECT_FALSE(packages.folder("bot"));
  EXPECT_FALSE(packages.folder("meta"));
  EXPECT_EQ(packages.model_folders(),
            std::vector<std::string>{workspace.path() + "/meta/bot_gazebo/models"});
}

TEST(Packages, HoldWhatModelAndPackageAddressesName) {
  const Workspace workspace;
  const SearchPaths paths = workspace.with_packages();
  EXPECT_EQ(models_of("model://hall", paths), 1U);
  EXPECT_EQ(models_of("model:///hall", paths), 1U);
  EXPECT_EQ(models_of("model://bot_description/sdf/model.sdf", paths), 1U);
  EXPECT_EQ(models_of("package://bot_description/sdf/model.sdf", paths), 1U);
  EXPECT_NE(error_of(in_world("<include><uri>package://bot/a.sdf</uri></include>"), paths)
                .find("is not found"),
            std::string::npos);
}

}  // namespace
}  // namespace angen::load
