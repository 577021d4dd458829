#include "core/private_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "core/diagnostics.h"

namespace angen::testing {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

struct PrivateFile : ::testing::Test {
  PrivateFile() {
    std::string name = (fs::temp_directory_path() / "private_file_XXXXXX").string();
    folder = mkdtemp(name.data());
  }
  ~PrivateFile() override { fs::remove_all(folder); }
  fs::path folder;
};

TEST_F(PrivateFile, ReplacesALinkAndLeavesWhatItNames) {
  std::ofstream(folder / "precious") << "mine";
  fs::create_symlink(folder / "precious", folder / "file");
  write_private_file((folder / "file").string(), "new");
  EXPECT_EQ(text_of(folder / "precious"), "mine");
  EXPECT_EQ(text_of(folder / "file"), "new");
  EXPECT_FALSE(fs::is_symlink(folder / "file"));
  struct stat state {};
  ASSERT_EQ(stat((folder / "file").c_str(), &state), 0);
  EXPECT_EQ(state.st_mode & 0777U, 0600U);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 2) << "no part is left";
}

TEST_F(PrivateFile, MakesFoldersForThisUserAlone) {
  const fs::path made = folder / "a" / "b";
  make_private_folder(made.string());
  EXPECT_EQ(fs::status(made).permissions(), fs::perms::owner_all);
  EXPECT_EQ(fs::status(folder / "a").permissions(), fs::perms::owner_all);
  fs::permissions(made, fs::perms::all);
  make_private_folder(made.string());
  EXPECT_EQ(fs::status(made).permissions(), fs::perms::owner_all);
}

TEST_F(PrivateFile, RejectsALinkOrAFileInPlaceOfAFolder) {
  fs::create_directory(folder / "theirs");
  fs::create_directory_symlink(folder / "theirs", folder / "link");
  EXPECT_THROW(make_private_folder((folder / "link").string()), Error);
  std::ofstream(folder / "file") << "x";
  EXPECT_THROW(make_private_folder((folder / "file").string()), Error);
  EXPECT_THROW(write_private_file((folder / "none" / "file").string(), "x"), Error);
}

TEST_F(PrivateFile, StateIsWhereTheXdgSpecificationSays) {
  setenv("XDG_STATE_HOME", folder.c_str(), 1);
  EXPECT_EQ(state_folder(), (folder / "angen").string());
  setenv("XDG_STATE_HOME", "relative", 1);
  setenv("HOME", folder.c_str(), 1);
  EXPECT_EQ(state_folder(), (folder / ".local/state/angen").string());
}

}  // namespace
}  // namespace angen::testing
