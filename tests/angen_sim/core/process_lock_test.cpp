#include "core/process_lock.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/diagnostics.h"

namespace angen::testing {
namespace {

namespace fs = std::filesystem;

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
