#include "core/files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

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

TEST(WriteAll, WritesMoreThanFitsAtOnce) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const std::string text(1 << 20, 'x');
  std::string got;
  std::thread reader([&] {
    char piece[4096];
    for (ssize_t n = 0; (n = read(ends[0], piece, sizeof piece)) > 0;) got.append(piece, n);
  });
  EXPECT_TRUE(write_all(ends[1], text));
  close(ends[1]);
  reader.join();
  close(ends[0]);
  EXPECT_EQ(got, text);
}

TEST(WriteAll, ReportsAFullDisk) {
  const int full = open("/dev/full", O_WRONLY | O_CLOEXEC);
  ASSERT_GE(full, 0);
  EXPECT_FALSE(write_all(full, "x"));
  EXPECT_EQ(errno, ENOSPC);
  close(full);
}

struct ProcessLock : ::testing::Test {
  ProcessLock() {
    std::string name = (fs::temp_directory_path() / "process_lock_XXXXXX").string();
    folder = mkdtemp(name.data());
  }
  ~ProcessLock() override { fs::remove_all(folder); }
  fs::path folder;
};

TEST_F(ProcessLock, AKeyIsTakenOnceAndOthersStayFree) {
  const std::string file = (folder / "locks").string();
  EXPECT_TRUE(lock_until_exit(file, "/angen"));
  EXPECT_FALSE(lock_until_exit(file, "/angen"));
  EXPECT_TRUE(lock_until_exit(file, "/other"));
  EXPECT_TRUE(lock_until_exit((folder / "more").string(), "/angen"));
  EXPECT_EQ(fs::file_size(file), 0U);
}

TEST_F(ProcessLock, TheEndOfTheProcessFreesIt) {
  const std::string file = (folder / "locks").string();
  const pid_t child = fork();
  if (child == 0) {
    lock_until_exit(file, "/angen");
    abort();
  }
  int state = 0;
  ASSERT_EQ(waitpid(child, &state, 0), child);
  ASSERT_TRUE(WIFSIGNALED(state));
  EXPECT_TRUE(lock_until_exit(file, "/angen"));
}

TEST_F(ProcessLock, ALinkIsNotFollowed) {
  fs::create_symlink(folder / "theirs", folder / "locks");
  EXPECT_THROW(lock_until_exit((folder / "locks").string(), "/angen"), Error);
  EXPECT_FALSE(fs::exists(folder / "theirs"));
}

}  // namespace
}  // namespace angen::testing
