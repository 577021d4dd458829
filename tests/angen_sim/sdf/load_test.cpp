#include <sys/stat.h>

#include <cstdlib>

#include "angen_sim/sdf/texts.h"

namespace angen::load {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> files_in(const std::string& folder, const std::string& extension) {
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == extension) files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

const std::string kModels = std::string(ANGEN_WORLDS_DIR) + "/models";

TEST(Worlds, LoadWithoutWarnings) {
  const std::vector<std::string> files = files_in(ANGEN_WORLDS_DIR, ".world");
  ASSERT_GE(files.size(), 2U);
  for (const std::string& file : files) {
    for (const Diagnostic& warning : world(file).warnings) ADD_FAILURE() << warning.text();
  }
}

TEST(Worlds, EveryModelOfTheDatabaseLoads) {
  int count = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(kModels)) {
    if (!fs::exists(entry.path() / "model.config")) continue;
    const desc::World w =
        world_from_text("<sdf version='1.6'><world name='w'><include><uri>model://" +
                            entry.path().filename().string() + "</uri></include></world></sdf>",
                        "text", SearchPaths::from_environment(kModels));
    for (const Diagnostic& warning : w.warnings) ADD_FAILURE() << warning.text();
    EXPECT_EQ(w.models.size() + w.lights.size(), 1U) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 10);
}

TEST(Worlds, TheBuildingHasItsParts) {
  const desc::World w = world(std::string(ANGEN_WORLDS_DIR) + "/angen.world");
  int hinges = 0;
  int people = 0;
  for (const desc::Model& m : w.models) {
    for (const desc::Joint& j : m.joints) hinges += j.name == "hinge" ? 1 : 0;
    people += m.is_actor ? 1 : 0;
  }
  EXPECT_EQ(hinges, 12);
  EXPECT_EQ(people, 1);
}

// The source's own pieces: all that may be said of them is that their handles do not turn.
TEST(Snippets, LoadWithNoWarningButZeroAxes) {
  const std::vector<std::string> files =
      files_in(std::string(ANGEN_TESTS_DIR) + "/angen_sim/sdf/snippets", ".sdf");
  ASSERT_GE(files.size(), 5U);
  int models = 0;
  for (const std::string& file : files) {
    std::ifstream stream(file);
    const std::string text((std::istreambuf_iterator<char>(stream)), {});
    const SearchPaths paths = SearchPaths::from_environment(kModels);
    std::vector<Diagnostic> warnings;
    if (text.find("<world") != std::string::npos) {
      const desc::World w = world_from_text(text, file, paths);
      models += static_cast<int>(w.models.size());
      warnings = w.warnings;
    } else {
      warnings = model(file, "", {}, paths).warnings;
      ++models;
    }
    for (const Diagnostic& warning : warnings) {
      EXPECT_NE(warning.message.find("axis of length 0"), std::string::npos) << warning.text();
    }
  }
  EXPECT_GE(models, 5);
}

TEST(Environment, PathsInTheirOrder) {
  setenv("ANGEN_MODEL_PATH", "/a:/b", 1);
  setenv("GAZEBO_MODEL_PATH", ":/c", 1);
  setenv("GAZEBO_RESOURCE_PATH", "/r", 1);
  const SearchPaths paths = SearchPaths::from_environment("/d");
  unsetenv("ANGEN_MODEL_PATH");
  unsetenv("GAZEBO_MODEL_PATH");
  unsetenv("GAZEBO_RESOURCE_PATH");
  ASSERT_GE(paths.models.size(), 5U);
  EXPECT_EQ(std::vector<std::string>(paths.models.begin(), paths.models.begin() + 4),
            (std::vector<std::string>{"/a", "/b", "/c", "/d"}));
  EXPECT_TRUE(fs::equivalent(paths.models[4], kModels));
  EXPECT_EQ(paths.resources, std::vector<std::string>{"/r"});
}

TEST(MissingFile, FolderOrPipeIsNotRead) {
  const Folder folder;
  const std::string pipe = folder.path() + "/pipe.world";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(world(pipe), Error);
  EXPECT_THROW(world(folder.path()), Error);
  const std::string mesh =
      "<visual name='v'><geometry><mesh><uri>model://pipe.world</uri></mesh></geometry></visual>";
  EXPECT_NE(error_of(in_link(mesh), folder.paths()).find("is not a regular file"),
            std::string::npos);
  const std::string ground =
      "<collision name='c'><geometry><heightmap><uri>model://pipe.world</uri>"
      "<size>1 1 1</size></heightmap></geometry></collision>";
  EXPECT_NE(error_of(in_link(ground), folder.paths()).find("is not a regular file"),
            std::string::npos);
}

/// They call themselves regular; whoever reads them waits for the kernel, or never comes to an end.
TEST(MissingFile, AFileOfTheKernelIsNotRead) {
  for (const std::string path : {"/proc/kmsg", "/proc/self/mem", "/sys/power/state", "/dev/zero"}) {
    if (!fs::exists(path)) continue;
    SearchPaths paths;
    paths.allow_any = true;
    try {
      world(path);
      FAIL() << path;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("is not a regular file"), std::string::npos) << path;
    }
    const std::string mesh = "<visual name='v'><geometry><mesh><uri>file://" + path +
                             "</uri></mesh></geometry></visual>";
    EXPECT_NE(error_of(in_link(mesh), paths).find("is not a regular file"), std::string::npos);
  }
}

TEST(MissingFile, IsNamed) { EXPECT_THROW(world("/nonexistent/x.world"), Error); }

}  // namespace
}  // namespace angen::load
