#include "plugin/library.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "angen_sim/fakes.h"

namespace angen {
namespace {

namespace fs = std::filesystem;

/// Plug-in paths of a test's own, and a directory to put files in.
class Library : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = fs::path(testing::TempDir()) / ("angen_library_" + std::to_string(::getpid()));
    fs::create_directories(directory_);
    unsetenv("GAZEBO_PLUGIN_PATH");
    search(ANGEN_FIXTURES_DIR);
  }
  void TearDown() override { fs::remove_all(directory_); }

  static void search(const std::string& path) { setenv("ANGEN_PLUGIN_PATH", path.c_str(), 1); }

  std::string complaint(const std::string& filename) {
    Catalog catalog;
    try {
      catalog.library(filename);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  fs::path directory_;
};

std::string twin_of(const Plugin& plugin) {
  Params nothing{Element{}};
  const auto sensor = plugin.make_sensor(nothing);
  Reading reading;
  Rng rng(1, 2, 3);
  sensor->read(test::FakeWorld(), {}, rng, reading);
  return reading.get<std::string>("twin");
}

TEST_F(Library, ASecondNameIsTheSameLibrary) {
  unsetenv("ANGEN_PLUGIN_PATH");
  Catalog catalog;
  const auto kind_of = [&](const std::string& file) {
    const auto& plugins = catalog.library(file);
    return plugins.size() == 1 ? plugins[0]->kind().name : "";
  };
  EXPECT_EQ(kind_of("libluminosity_sensor_controller.so"), "luminosity");
  EXPECT_EQ(kind_of("libluminosity_sensor_utils.so"), "luminosity");
  const std::vector<std::string> all = Catalog().available();
  EXPECT_EQ(std::count(all.begin(), all.end(), "libluminosity_sensor_controller.so"), 1);
  EXPECT_EQ(std::count(all.begin(), all.end(), "libluminosity_sensor_utils.so"), 0);
}

TEST_F(Library, FindsAngensOwnBesideItsLibraries) {
  unsetenv("ANGEN_PLUGIN_PATH");
  Catalog catalog;
  const auto& plugins = catalog.library("libpir_controller.so");
  ASSERT_EQ(plugins.size(), 1U);
  EXPECT_EQ(plugins[0]->kind().name, "pir");
  EXPECT_TRUE(plugins[0]->makes_sensors());
  EXPECT_EQ(plugins[0]->make_device(), nullptr);
}

TEST_F(Library, FindsAUsersOnEitherPath) {
  for (const char* variable : {"ANGEN_PLUGIN_PATH", "GAZEBO_PLUGIN_PATH"}) {
    unsetenv("ANGEN_PLUGIN_PATH");
    unsetenv("GAZEBO_PLUGIN_PATH");
    setenv(variable, ("/nowhere::" + std::string(ANGEN_FIXTURES_DIR)).c_str(), 1);
    Catalog catalog;
    EXPECT_EQ(catalog.library("libtwin_a.so").at(0)->kind().name, "twin_a") << variable;
  }
}

TEST_F(Library, TakesAPathThatLiesOnThePluginPath) {
  fs::create_directory_symlink(ANGEN_FIXTURES_DIR, directory_ / "link");
  const fs::path around = directory_ / ".." / directory_.filename() / "link/libtwin_a.so";
  for (const std::string& path :
       {std::string(ANGEN_FIXTURES_DIR "/libtwin_a.so"), around.string()}) {
    Catalog catalog;
    EXPECT_EQ(catalog.library(path).at(0)->kind().name, "twin_a") << path;
  }
  EXPECT_EQ(complaint(ANGEN_FIXTURES_DIR "/libx.so"),
            "there is no plug-in library " ANGEN_FIXTURES_DIR "/libx.so");
}

/// A file that the constructor of a hostile library writes.
class HostileLibrary : public Library {
 protected:
  void SetUp() override {
    Library::SetUp();
    mark_ = directory_ / "mark";
    setenv("ANGEN_EVIL", mark_.c_str(), 1);
  }
  void TearDown() override {
    unsetenv("ANGEN_EVIL");
    Library::TearDown();
  }
  bool ran() const { return fs::exists(mark_); }

  fs::path mark_;
};

TEST_F(HostileLibrary, ElsewhereIsNotLoaded) {
  const fs::path file = directory_ / "libevil_plugin.so";
  fs::copy_file(ANGEN_FIXTURES_DIR "/elsewhere/libevil_plugin.so", file);
  fs::create_directory(directory_ / "path");
  search(directory_ / "path");
  const std::string relative = fs::relative(file).string();
  const std::string around = directory_ / "path/../libevil_plugin.so";
  for (const std::string& path : {file.string(), relative, around}) {
    EXPECT_NE(complaint(path).find("is not on the plug-in path"), std::string::npos) << path;
    EXPECT_EQ(find_library(path), "") << path;
  }
  EXPECT_NE(complaint("../libevil_plugin.so").find("is not on"), std::string::npos);
  EXPECT_NE(complaint("libevil_plugin.so").find("is not found"), std::string::npos);
  EXPECT_FALSE(ran());
}

TEST_F(HostileLibrary, WithoutAPluginIsNotLoadedFromThePathEither) {
  for (const char* name : {"libevil.so", ANGEN_FIXTURES_DIR "/libevil.so"}) {
    EXPECT_NE(complaint(name).find("no Angen plug-in in"), std::string::npos);
  }
  EXPECT_EQ(describe(*std::make_unique<Catalog>()).empty(), false);
  EXPECT_FALSE(ran());
}

TEST_F(HostileLibrary, IsLoadedWhereEveryPathIsAllowed) {
  const std::string file = ANGEN_FIXTURES_DIR "/elsewhere/libevil_plugin.so";
  EXPECT_EQ(Catalog(true).library(file).at(0)->kind().name, "evil");
  EXPECT_TRUE(ran()) << "the other tests would not notice it";
}

TEST_F(HostileLibrary, TheEnvironmentAllowsEveryPath) {
  setenv("ANGEN_ALLOW_PATHS", "true", 1);
  const std::string complained = complaint("/nowhere/libx.so");
  setenv("ANGEN_ALLOW_PATHS", "false", 1);
  const std::string not_allowed = complaint("/nowhere/libx.so");
  unsetenv("ANGEN_ALLOW_PATHS");
  EXPECT_EQ(complained, "there is no plug-in library /nowhere/libx.so");
  EXPECT_NE(not_allowed.find("is not on"), std::string::npos);
}

TEST_F(Library, AskedTwiceIsLoadedOnce) {
  Catalog catalog;
  EXPECT_EQ(&catalog.library("libtwin_a.so"), &catalog.library("libtwin_a.so"));
}

TEST_F(Library, ClassesOfTheSameNameDoNotMix) {
  Catalog catalog;
  const auto a = catalog.library("libtwin_a.so").at(0);
  const auto b = catalog.library("libtwin_b.so").at(0);
  EXPECT_EQ(twin_of(*a), "a");
  EXPECT_EQ(twin_of(*b), "b");
  Catalog second;
  EXPECT_EQ(twin_of(*second.library("libtwin_a.so").at(0)), "a");
}

TEST_F(Library, APluginKeepsItsLibraryWhenTheCatalogIsGone) {
  std::shared_ptr<const Plugin> plugin;
  {
    Catalog catalog;
    plugin = catalog.library("libtwin_a.so").at(0);
  }
  EXPECT_EQ(twin_of(*plugin), "a");
}

TEST_F(Library, CatalogsMayComeAndGo) {
  for (int i = 0; i < 50; ++i) {
    Catalog catalog;
    EXPECT_EQ(twin_of(*catalog.library("libtwin_b.so").at(0)), "b");
  }
}

TEST_F(Library, NotFoundListsWhereItLooked) {
  setenv("ANGEN_PLUGIN_PATH", "/one:/two", 1);
  setenv("GAZEBO_PLUGIN_PATH", "/three", 1);
  const std::string text = complaint("libnowhere.so");
  EXPECT_EQ(text.find("plug-in library libnowhere.so is not found; searched /one, /two, /three, " +
                      fs::canonical(ANGEN_PLUGIN_DIR).string()),
            0U)
      << text;
}

TEST_F(Library, SearchesAFolderThatIsOnThePathTwiceOnce) {
  setenv("ANGEN_PLUGIN_PATH", "/one:/one", 1);
  setenv("GAZEBO_PLUGIN_PATH", "/one", 1);
  EXPECT_EQ(complaint("libnowhere.so").find("searched /one, /"),
            std::string("plug-in library libnowhere.so is not found; ").size());
}

TEST_F(Library, SuggestsTheOneThatWasMeant) {
  EXPECT_EQ(complaint("libreed_contcat.so"),
            "plug-in library libreed_contcat.so is not found; did you mean libreed_contact.so?");
}

TEST_F(Library, OfTheSameNameWithoutAngenPluginIsPassedOver) {
  fs::copy_file(ANGEN_FIXTURES_DIR "/libempty.so", directory_ / "libtwin_a.so");
  search(directory_.string() + ":" ANGEN_FIXTURES_DIR);
  Catalog catalog;
  EXPECT_EQ(catalog.library("libtwin_a.so").at(0)->kind().name, "twin_a");
}

TEST_F(Library, NotLoadableGivesTheLoadersReason) {
  EXPECT_NE(complaint("libunresolved.so").find("undefined symbol: _Z16missing_functionv"),
            std::string::npos);
  std::ofstream(directory_ / "libtext.so") << std::string(4096, 'x');
  search(directory_);
  const std::string text = complaint("libtext.so");
  EXPECT_NE(text.find("libtext.so is not a shared library"), std::string::npos) << text;
}

TEST_F(Library, ListsThoseThatHoldPlugins) {
  Catalog catalog;
  const std::vector<std::string> names = catalog.available();
  const auto has = [&](const char* name) {
    return std::count(names.begin(), names.end(), name) == 1;
  };
  EXPECT_TRUE(has("libtwin_a.so"));
  EXPECT_TRUE(has("libtwin_b.so"));
  EXPECT_TRUE(has("libpir_controller.so"));
  EXPECT_FALSE(has("libempty.so"));
  EXPECT_FALSE(has("libangen_plugin.so"));
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
}

TEST_F(Library, APluginOfThisProcessIsFoundByItsName) {
  struct Local : Plugin {
    const Kind& kind() const override {
      static const Kind kind("local", "");
      return kind;
    }
  };
  Catalog catalog;
  catalog.add("local.py", std::make_shared<Local>());
  EXPECT_EQ(catalog.library("local.py").at(0)->kind().name, "local");
}

TEST_F(Library, DescribesEveryParameter) {
  Catalog catalog;
  const std::vector<PluginDoc> docs = describe(catalog);
  const auto twin = std::find_if(docs.begin(), docs.end(),
                                 [](const PluginDoc& doc) { return doc.kind.name == "twin_a"; });
  ASSERT_NE(twin, docs.end());
  ASSERT_FALSE(twin->params.empty());
  EXPECT_EQ(twin->params[0].path, "parameter_a");
  EXPECT_EQ(twin->params[0].unit, "m");
  const auto pir = std::find_if(docs.begin(), docs.end(),
                                [](const PluginDoc& doc) { return doc.kind.name == "pir"; });
  ASSERT_NE(pir, docs.end());
  std::vector<std::string> paths;
  for (const ParamDoc& param : pir->params) paths.push_back(param.path);
  for (const char* path :
       {"threshold", "nod_period", "ray/range/max", "update_rate", "topicName"}) {
    EXPECT_EQ(std::count(paths.begin(), paths.end(), path), 1) << path;
  }
}

TEST_F(Library, DescribesWhatDoesNotLoadByItsReason) {
  Catalog catalog;
  bool found = false;
  for (const PluginDoc& doc : describe(catalog)) {
    if (doc.library != "libunresolved.so") continue;
    found = true;
    EXPECT_EQ(doc.kind.name, "");
    EXPECT_NE(doc.kind.doc.find("missing_function"), std::string::npos);
  }
  EXPECT_TRUE(found);
}

TEST_F(Library, AProcessThatStillHoldsLibrariesEndsWell) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(
      {
        static Catalog catalog;
        static const auto plugin = catalog.library("libtwin_a.so").at(0);
        Params nothing{Element{}};
        static const auto sensor = plugin->make_sensor(nothing);
        std::exit(sensor == nullptr ? 1 : 0);
      },
      testing::ExitedWithCode(0), "^$");
}

}  // namespace
}  // namespace angen
