#include "record/log.h"

#include <sys/resource.h>

#include <csignal>

#include "angen_sim/record/logged.h"
#include "core/random.h"

namespace angen::record {
namespace {

std::string wrong_with(const std::string& path) {
  try {
    read_log(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void record(const Folder& folder) {
  Session session(folder);
  session.command("lamp", "hall0", "On");
  session.run(1.5);
  session.command("lamp", "hall0", "Off");
  session.run(2.0);
}

TEST(Log, SaysWhereItIsDamaged) {
  const Folder folder;
  record(folder);
  const std::string whole = read_all(folder.log());
  const std::string bad = folder.log() + ".bad";
  const std::size_t second = whole.find('\n') + 1;
  const std::size_t third = whole.find('\n', second) + 1;
  const std::size_t at = whole.find("\"On\"", second);
  ASSERT_NE(at, std::string::npos);

  std::string changed = whole;
  changed[at + 1] = 'I';
  write_all(bad, changed);
  EXPECT_EQ(wrong_with(bad), bad + ":2: is damaged, the line that begins at byte " +
                                 std::to_string(second) +
                                 " of the file: its checksum is not that of this line and those "
                                 "before it");
  changed = whole;
  changed[at - 1] = '\0';
  write_all(bad, changed);
  EXPECT_EQ(wrong_with(bad).find(bad + ":2: is damaged at byte " + std::to_string(at - 1)), 0U)
      << wrong_with(bad);
  write_all(bad, whole.substr(0, second) + whole.substr(third));
  EXPECT_EQ(wrong_with(bad).find(bad + ":2: is damaged"), 0U) << "a line is missing";
  write_all(bad, "<sdf/>\n");
  EXPECT_EQ(wrong_with(bad), bad + ":1: is not a log of angen; it must begin with {\"angen_log\"");
  write_all(bad, whole.substr(0, 200));
  EXPECT_EQ(wrong_with(bad), bad + ":1: ends within its first line; nothing can be replayed");
  write_all(bad, "");
  EXPECT_NE(wrong_with(bad).find("is empty"), std::string::npos);
  EXPECT_NE(wrong_with(bad + "x").find("cannot be read"), std::string::npos);
}

// Any byte that is changed or lost is found, and named by its line.
TEST(Log, EveryDamageIsFound) {
  const Folder folder;
  record(folder);
  const std::string whole = read_all(folder.log());
  const std::string bad = folder.log() + ".bad";
  Rng rng(1, 2, 3);
  for (int i = 0; i < 300; ++i) {
    std::string changed = whole;
    const std::size_t at = rng.next() % (whole.size() - 1);
    const bool lost = i % 3 == 0;
    if (lost) {
      changed.erase(at, 1 + rng.next() % 40);
    } else {
      changed[at] = static_cast<char>(changed[at] ^ static_cast<char>(1 + rng.next() % 255));
    }
    write_all(bad, changed);
    const std::string wrong = wrong_with(bad);
    if (!wrong.empty()) {
      EXPECT_EQ(wrong.find(bad + ":"), 0U) << wrong;
    } else {
      EXPECT_NE(read_log(bad).truncated, "") << at;
    }
  }
}

TEST(Log, OfAnotherVersionIsRefused) {
  const Folder folder;
  record(folder);
  std::string text = read_all(folder.log());
  const std::string version = "\"version\":\"" + this_version();
  text.replace(text.find(version), version.size(), "\"version\":\"0.0.7");
  write_all(folder.log(), text);
  EXPECT_EQ(wrong_with(folder.log()),
            folder.log() + ":1: was recorded by angen 0.0.7 (format 1), this is angen " +
                this_version() + " (format 1); replay it with the version that recorded it");
}

TEST(Log, IsReadUpToAnIncompleteLastLine) {
  const Folder folder;
  record(folder);
  const std::string whole = read_all(folder.log());
  const std::size_t last = whole.rfind('\n', whole.size() - 2) + 1;
  write_all(folder.log(), whole.substr(0, last + 20));
  const Log log = read_log(folder.log());
  EXPECT_NE(log.truncated.find("begins at byte " + std::to_string(last)), std::string::npos)
      << log.truncated;
  const Replay replay = replayed(folder.log());
  EXPECT_EQ(replay.mismatch(), "");
  EXPECT_EQ(replay.compared(), 3U);
}

TEST(Log, IsNotOverwritten) {
  const Folder folder;
  record(folder);
  const std::string before = read_all(folder.log());
  EXPECT_THROW(Session again(folder), Error);
  EXPECT_EQ(read_all(folder.log()), before);
}

// A full disk ends the log with a whole line, and not the run.
TEST(Log, OfAFullDiskCanBeReplayed) {
  const Folder folder;
  Session session(folder);
  session.run(1.5);
  const auto old = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit few = before;
  few.rlim_cur = std::filesystem::file_size(folder.log()) + 150;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &few), 0);
  session.run(4.0);
  EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, old);
  EXPECT_NE(session.recorder->error().find("cannot be written any more"), std::string::npos);
  EXPECT_EQ((*session).snapshot()->time, from_seconds(5.5)) << "the run goes on";
  session.end();
  const Replay replay = replayed(folder.log());
  EXPECT_EQ(replay.log().truncated, "");
  EXPECT_EQ(replay.mismatch(), "");
  EXPECT_EQ(replay.compared(), 2U);
}

}  // namespace
}  // namespace angen::record
