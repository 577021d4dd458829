#include "sdf/cache.h"

#include <algorithm>
#include <cereal/details/helpers.hpp>
#include <chrono>
#include <cstdlib>
#include <iterator>

#include "angen_sim/sdf/texts.h"
#include "sdf/pack.h"

namespace angen::load {
namespace {

namespace fs = std::filesystem;

/// Sets a variable of the environment, and puts it back.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    setenv(name, value.c_str(), 1);
  }
  ~Variable() {
    if (old_) {
      setenv(name_, old_->c_str(), 1);
    } else {
      unsetenv(name_);
    }
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

std::string bytes_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

const char* const kPyramid =
    "solid p\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
    "endloop\nendfacet\nendsolid p\n";

/// A small world with an include, a mesh and a warning, and a cache of its own.
class CacheTest : public testing::Test {
 protected:
  CacheTest()
      : cache_("XDG_CACHE_HOME", (fs::path(folder_.path()) / "cache").string()),
        on_("ANGEN_NO_CACHE", "") {
    folder_.write("models/thing/p.stl", kPyramid);
    folder_.model("models/thing",
                  sdf("<model name=\"thing\"><link name=\"l\">" + box() +
                      "<visual name=\"v\"><geometry><mesh><uri>model://thing/p.stl</uri></mesh>"
                      "</geometry></visual></link><link name=\"m\"/></model>"));
    write_world("thing");
  }

  void write_world(const std::string& name) {
    path_ = folder_.write("small.world", in_world("<include><uri>model://thing</uri><name>" + name +
                                                  "</name></include><physics type=\"bullet\"/>"));
  }
  SearchPaths paths() const {
    return SearchPaths::from_environment((fs::path(path_).parent_path() / "models").string());
  }
  Cache cache() const { return Cache(path_, paths()); }
  bool kept() const { return cache().recall().has_value(); }
  std::string uncached() const {
    const Variable off("ANGEN_NO_CACHE", "1");
    return pack(world(path_));
  }

  Folder folder_;
  Variable cache_;
  Variable on_;
  std::string path_;
};

TEST_F(CacheTest, GivesWhatWasReadWithItsWarnings) {
  EXPECT_FALSE(kept());
  const desc::World first = world(path_);
  const std::optional<desc::World> again = cache().recall();
  ASSERT_TRUE(again);
  EXPECT_EQ(pack(*again), pack(first));
  ASSERT_EQ(again->warnings.size(), 1U);
  EXPECT_EQ(again->warnings[0].text(), first.warnings[0].text());
  EXPECT_EQ(again->models.at(0).links.at(0).visuals.at(0).shape.mesh->triangles.size(), 1U);
  EXPECT_EQ(pack(world(path_)), pack(first));
}

TEST_F(CacheTest, IsStaleWhenTheWorldChanges) {
  world(path_);
  write_world("other");
  EXPECT_FALSE(kept());
  EXPECT_EQ(world(path_).models.at(0).name, "other");
  EXPECT_EQ(cache().recall()->models.at(0).name, "other");
}

TEST_F(CacheTest, IsStaleWhenAModelOrItsMeshOrItsConfigChanges) {
  for (const std::string file : {"model.sdf", "p.stl", "model.config"}) {
    world(path_);
    ASSERT_TRUE(kept());
    const std::string name = "models/thing/" + file;
    const std::string old = bytes_of((fs::path(folder_.path()) / name).string());
    folder_.write(name, old + "\n");
    EXPECT_FALSE(kept()) << file;
    folder_.write(name, old);
    EXPECT_TRUE(kept()) << file;
    fs::remove(fs::path(folder_.path()) / name);
    EXPECT_FALSE(kept()) << file;
    folder_.write(name, old);
  }
}

TEST_F(CacheTest, IsStaleWhenAModelAppearsWhereItIsLookedForFirst) {
  const Variable first("ANGEN_MODEL_PATH", (fs::path(folder_.path()) / "first").string());
  world(path_);
  ASSERT_TRUE(kept());
  folder_.model("first/thing", sdf("<model name=\"thing\"><link name=\"mine\"/></model>"));
  EXPECT_FALSE(kept());
  EXPECT_EQ(world(path_).models.at(0).links.at(0).name, "mine");
}

TEST_F(CacheTest, BelongsToItsSearchPath) {
  world(path_);
  folder_.model("second/thing", sdf("<model name=\"thing\"><link name=\"mine\"/></model>"));
  const Variable path("ANGEN_MODEL_PATH", (fs::path(folder_.path()) / "second").string());
  EXPECT_EQ(world(path_).models.at(0).links.at(0).name, "mine");
}

TEST_F(CacheTest, DamagedAnywhereItIsIgnored) {
  world(path_);
  const std::string file = cache().file();
  const std::string whole = bytes_of(file);
  ASSERT_GT(whole.size(), 1000U);
  const auto write = [&](const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
  };
  for (std::size_t at = 0; at < whole.size(); at += at < 200 ? 1 : 13) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << (at % 8)));
    write(bytes);
    ASSERT_FALSE(kept()) << "byte " << at;
    write(whole.substr(0, at));
    ASSERT_FALSE(kept()) << "cut off after " << at;
  }
  write(whole + "x");
  EXPECT_FALSE(kept());
  EXPECT_EQ(pack(world(path_)), uncached());
  EXPECT_TRUE(kept());
}

TEST_F(CacheTest, OfAnotherWorldItIsIgnored) {
  world(path_);
  const std::string other = folder_.write("other.world", in_world(""));
  world(other);
  fs::copy_file(Cache(other, paths()).file(), cache().file(), fs::copy_options::overwrite_existing);
  EXPECT_FALSE(kept());
  EXPECT_EQ(world(path_).models.size(), 1U);
}

TEST_F(CacheTest, ThatCannotBeWrittenDoesNotMatter) {
  const Variable nowhere("XDG_CACHE_HOME", path_);  // a file
  EXPECT_EQ(pack(world(path_)), uncached());
  EXPECT_FALSE(kept());
}

TEST_F(CacheTest, LeavesNothingBehindWhereItIsOff) {
  const Variable off("ANGEN_NO_CACHE", "1");
  world(path_);
  EXPECT_FALSE(fs::exists(fs::path(folder_.path()) / "cache"));
}

TEST_F(CacheTest, OfABadWorldIsNone) {
  world(path_);
  write_world("a::b");
  const auto error = [&] {
    try {
      world(path_);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const std::string first = error();
  EXPECT_NE(first.find("small.world:1: "), std::string::npos) << first;
  EXPECT_EQ(error(), first);
  EXPECT_FALSE(kept());
}

TEST_F(CacheTest, LosesWhatWasNotUsedForLongestWhenItIsFull) {
  const fs::path where = fs::path(cache().file()).parent_path();
  const auto old_file = [&](int hours) { return where / (std::to_string(hours) + "h.world"); };
  for (const int hours : {1, 2, 3}) {
    folder_.write("cache/angen/" + old_file(hours).filename().string(), "");
    fs::resize_file(old_file(hours), 50U << 20U);  // sparse: takes no room on the disk
    fs::last_write_time(old_file(hours),
                        fs::file_time_type::clock::now() - std::chrono::hours(hours));
  }
  world(path_);
  EXPECT_TRUE(kept());
  EXPECT_TRUE(fs::exists(old_file(1)));
  EXPECT_TRUE(fs::exists(old_file(2)));
  EXPECT_FALSE(fs::exists(old_file(3))) << "128 MB are full";
}

TEST_F(CacheTest, CountsAFileAsUsedWhenItIsRead) {
  world(path_);
  const auto old = fs::file_time_type::clock::now() - std::chrono::hours(9);
  fs::last_write_time(cache().file(), old);
  ASSERT_TRUE(kept());
  EXPECT_GT(fs::last_write_time(cache().file()), old + std::chrono::hours(8));
}

TEST_F(CacheTest, GivesTheWholeBuildingByteByByte) {
  path_ = std::string(ANGEN_WORLDS_DIR) + "/angen.world";
  const std::string first = pack(world(path_));
  ASSERT_TRUE(kept());
  EXPECT_EQ(pack(world(path_)), first);
  EXPECT_EQ(uncached(), first);
}

TEST(Pack, SizesBeyondTheBytesThrowBeforeMemoryIsTaken) {
  desc::World world;
  world.name = "w";
  std::string bytes = pack(world);
  ASSERT_EQ(unpack(bytes).name, "w");
  ASSERT_EQ(bytes[0], 1);  // the length of the name, in 8 bytes
  bytes[4] = 1;            // 4 GB
  EXPECT_THROW(unpack(bytes), cereal::Exception);
}

TEST(Pack, FlagsThatAreNeitherThrow) {
  desc::World world;
  world.models.emplace_back();
  const std::string off = pack(world);
  world.models[0].is_static = true;
  std::string bytes = pack(world);
  const auto differs = std::mismatch(bytes.begin(), bytes.end(), off.begin()).first;
  ASSERT_NE(differs, bytes.end());
  *differs = 7;
  EXPECT_THROW(unpack(bytes), cereal::Exception);
}

}  // namespace
}  // namespace angen::load
