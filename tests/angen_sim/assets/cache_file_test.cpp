#include "assets/cache_file.h"

#include <sys/stat.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>

#include "angen_sim/sdf/texts.h"
#include "document/xml.h"

namespace angen::load {
namespace {

namespace fs = std::filesystem;

/// A cache of its own.
class CacheFile : public testing::Test {
 protected:
  CacheFile() {
    setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1);
    unsetenv("ANGEN_NO_CACHE");
    file_ = cache_file("key", ".mesh");
  }
  ~CacheFile() override { unsetenv("XDG_CACHE_HOME"); }

  Folder folder_;
  std::string file_;
};

TEST_F(CacheFile, ReturnsItsBytes) {
  EXPECT_FALSE(read_cache_file(file_));
  write_cache_file(file_, "bytes");
  EXPECT_EQ(read_cache_file(file_), "bytes");
  EXPECT_NE(cache_file("other key", ".mesh"), file_);
}

TEST_F(CacheFile, DamagedAnywhereItIsIgnored) {
  write_cache_file(file_, "some bytes");
  const std::string whole = read_file(file_);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << (at % 8)));
    std::ofstream(file_, std::ios::binary) << bytes;
    EXPECT_FALSE(read_cache_file(file_)) << "byte " << at;
    std::ofstream(file_, std::ios::binary) << whole.substr(0, at);
    EXPECT_FALSE(read_cache_file(file_)) << "cut off after " << at;
  }
  std::ofstream(file_, std::ios::binary) << whole;
  EXPECT_TRUE(read_cache_file(file_));
}

TEST_F(CacheFile, APipeIsNotOpened) {
  fs::create_directories(fs::path(file_).parent_path());
  ASSERT_EQ(mkfifo(file_.c_str(), 0600), 0);
  EXPECT_FALSE(read_cache_file(file_));
}

TEST_F(CacheFile, HasNoNameIfItIsOff) {
  setenv("ANGEN_NO_CACHE", "1", 1);
  EXPECT_EQ(cache_file("key", ".mesh"), "");
  unsetenv("ANGEN_NO_CACHE");
}

TEST_F(CacheFile, AFolderThatCannotBeMadeThrows) {
  setenv("XDG_CACHE_HOME", folder_.write("file", "").c_str(), 1);
  EXPECT_THROW(write_cache_file(cache_file("key", ".mesh"), "bytes"), std::exception);
}

TEST_F(CacheFile, LosesWhatWasNotUsedForLongestWhenItIsFull) {
  const auto now = fs::file_time_type::clock::now();
  const auto old_file = [&](int hours) {
    return fs::path(file_).parent_path() / (std::to_string(hours) + "h.mesh");
  };
  for (const int hours : {1, 2, 3}) {
    folder_.write("angen/" + old_file(hours).filename().string(), "");
    fs::resize_file(old_file(hours), 50U << 20U);  // sparse: takes no room on the disk
    fs::last_write_time(old_file(hours), now - std::chrono::hours(hours));
  }
  write_cache_file(file_, "bytes");
  EXPECT_TRUE(read_cache_file(file_));
  EXPECT_TRUE(fs::exists(old_file(1)));
  EXPECT_TRUE(fs::exists(old_file(2)));
  EXPECT_FALSE(fs::exists(old_file(3))) << "128 MB are full";
}

TEST_F(CacheFile, CountsAsUsedWhenItIsRead) {
  write_cache_file(file_, "bytes");
  const auto old = fs::file_time_type::clock::now() - std::chrono::hours(9);
  fs::last_write_time(file_, old);
  ASSERT_TRUE(read_cache_file(file_));
  EXPECT_GT(fs::last_write_time(file_), old + std::chrono::hours(8));
}

}  // namespace
}  // namespace angen::load
