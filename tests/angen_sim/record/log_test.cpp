#include "record/log.h"

#include <sys/resource.h>
#include <sys/stat.h>

#include <array>
#include <csignal>
#include <filesystem>

#include "angen_sim/record/logged.h"
#include "core/random.h"

namespace angen::record {
namespace {

std::string wrong_in_log(const std::string& path) {
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
  EXPECT_EQ(wrong_in_log(bad), bad + ":2: is damaged, the line that begins at byte " +
                                   std::to_string(second) +
                                   " of the file: its checksum is not that of this line and those "
                                   "before it");
  changed = whole;
  changed[at - 1] = '\0';
  write_all(bad, changed);
  EXPECT_EQ(wrong_in_log(bad).find(bad + ":2: is damaged at byte " + std::to_string(at - 1)), 0U)
      << wrong_in_log(bad);
  write_all(bad, whole.substr(0, second) + whole.substr(third));
  EXPECT_EQ(wrong_in_log(bad).find(bad + ":2: is damaged"), 0U) << "a line is missing";
  write_all(bad, "<sdf/>\n");
  EXPECT_EQ(wrong_in_log(bad),
            bad + ":1: is not a log of angen; it must begin with {\"angen_log\"");
  write_all(bad, whole.substr(0, 200));
  EXPECT_EQ(wrong_in_log(bad), bad + ":1: ends within its first line; nothing can be replayed");
  write_all(bad, "");
  EXPECT_NE(wrong_in_log(bad).find("is empty"), std::string::npos);
  EXPECT_NE(wrong_in_log(bad + "x").find("cannot be read"), std::string::npos);
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
    const std::string wrong = wrong_in_log(bad);
    if (!wrong.empty()) {
      EXPECT_EQ(wrong.find(bad + ":"), 0U) << wrong;
    } else {
      EXPECT_NE(read_log(bad).truncated, "") << at;
    }
  }
}

TEST(Log, OfAnotherVersionIsRejected) {
  const Folder folder;
  record(folder);
  std::string text = read_all(folder.log());
  const std::string version = "\"version\":\"" + this_version();
  text.replace(text.find(version), version.size(), "\"version\":\"0.0.7");
  write_all(folder.log(), text);
  EXPECT_EQ(wrong_in_log(folder.log()),
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

TEST(Log, IsAFileThatBeginsAsOne) {
  const Folder folder;
  const std::string pipe = folder.log() + ".fifo";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);  // whoever opened it would wait for a writer
  const std::string nulls = folder.log() + ".nulls";
  write_all(nulls, "");
  std::filesystem::resize_file(nulls, 4'000'000'000);  // one line, without a break
  for (const std::string& path : {pipe, nulls, std::string("/dev/zero"), std::string("/")}) {
    EXPECT_THROW(read_log(path), Error) << path;
  }
}

TEST(Log, IsNotOverwritten) {
  const Folder folder;
  record(folder);
  const std::string before = read_all(folder.log());
  EXPECT_THROW(Session again(folder), Error);
  EXPECT_EQ(read_all(folder.log()), before);
}

/// The log again with one text replaced in each line that has it, with the right checksums.
std::string forged(const std::string& whole, const std::string& from, const std::string& to) {
  std::istringstream lines(whole);
  std::string all;
  std::uint64_t sum = 0;
  for (std::string line; std::getline(lines, line);) {
    line.resize(line.rfind(",\"sum\""));
    const std::size_t at = line.find(from);
    if (at != std::string::npos) line.replace(at, from.size(), to);
    sum = hash_bytes(line, sum);
    all += line + ",\"sum\":\"" + fingerprint_text(sum) + "\"}\n";
  }
  return all;
}

TEST(Log, WhatIsMissingOrOfAnotherTypeIsAnError) {
  const Folder folder;
  {
    Session session(folder);
    (*session).post(crate("one", 0.5, 1.0));
    (*session).post(sim::Attach{
        load::sensor(sim::custom("air", "temperature_sensor", ""), "air", {}), "brick::link"});
    (*session).post(sim::ToDevice{"heater", "stove", {"", {0.5}}});
    (*session).post(sim::Note{"a", "b", "c", "d"});
    (*session).post(sim::Reject{"a", "b", "c"});
    (*session).post(sim::Delete{"one"});
    (*session).post(sim::Pause{true});
    (*session).post(sim::Reset{true});
    (*session).post(sim::Step{10});
    (*session).request("lidar", "none", true);
    session.tick();
  }
  const std::string whole = read_all(folder.log());
  EXPECT_EQ(forged(whole, "nothing that is there", ""), whole);
  const std::string bad = folder.log() + ".bad";
  for (const char* key : {"version",   "host",   "seed",   "step",  "world",  "models", "files",
                          "sdf",       "tick",   "batch",  "do",    "kind",   "name",   "text",
                          "values",    "verb",   "number", "pose",  "on",     "paused", "ticks",
                          "with_time", "source", "reason", "event", "detail", "wanted", "hash"}) {
    const std::string quoted = "\"" + std::string(key) + "\":";
    ASSERT_NE(whole.find(quoted), std::string::npos) << key;
    write_all(bad, forged(whole, quoted, "\"x\":"));
    EXPECT_NE(wrong_in_log(bad).find("'" + std::string(key) + "' is missing, or not "),
              std::string::npos)
        << wrong_in_log(bad);
    write_all(bad, forged(whole, quoted, quoted + "{},\"x\":"));
    EXPECT_NE(wrong_in_log(bad).find("'" + std::string(key) + "' is missing, or not "),
              std::string::npos)
        << wrong_in_log(bad);
  }
  for (const auto& [from, to, why] : std::vector<std::array<std::string, 3>>{
           {"\"tick\":0", "\"tick\":18446744073709551615", "'tick' exceeds the largest time"},
           {"\"tick\":0", "\"tick\":-1", "'tick' is missing, or not a whole number"},
           {"\"do\":\"delete\"", "\"do\":\"explode\"", "'explode' is not an action of a log"},
           {"\"step\":1000000", "\"step\":0", "'step' is not 1 ns to 1 s"},
           {"\"pose\":[", "\"pose\":[1,", "'pose' has not 7 numbers"}}) {
    write_all(bad, forged(whole, from, to));
    EXPECT_NE(wrong_in_log(bad).find(why), std::string::npos) << wrong_in_log(bad);
  }
}

TEST(Log, ActionsThatCannotBeAreErrorsWithTheirLine) {
  const Folder folder;
  {
    Session session(folder);
    session.run(0.5);
    (*session).post(crate("one", 0.5, 1.0));
    (*session).post(sim::Pause{true});
    session.tick();
    (*session).post(sim::Step{10});
    session.tick();
  }
  const std::string whole = read_all(folder.log());
  const auto rejection = [&](const std::string& from, const std::string& to) {
    write_all(folder.log(), forged(whole, from, to));
    try {
      replayed(folder.log());
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto expect = [&](const std::string& from, const std::string& to, const std::string& why) {
    EXPECT_NE(rejection(from, to).find(why), std::string::npos) << rejection(from, to);
  };
  EXPECT_EQ(rejection("", ""), "");
  expect("\"pose\":[0.5", "\"pose\":[NaN", "run.log:2: cannot be replayed: its pose is not that");
  expect("\"pose\":[0.5", "\"pose\":[1e300", "run.log:2: cannot be replayed: its pose is not that");
  expect("<model name=\\\"one\\\"", "<modle name=\\\"one\\\"", "run.log:2: cannot be replayed: ");
  expect("\"tick\":501", "\"tick\":300", "belongs to tick 300, but the replay is at tick 501");
  expect("\"tick\":500,\"batch\":1", "\"tick\":900,\"batch\":1",
         "run.log:4: belongs to tick 900, but the replay has ended at tick 500");
  expect("\"tick\":500", "\"tick\":500000000",
         "'tick' is more than a second later than in the line before");
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
  EXPECT_NE(session.recorder->error().find("can no longer be written"), std::string::npos);
  EXPECT_EQ((*session).snapshot()->time, from_seconds(5.5)) << "the run continues";
  session.end();
  const Replay replay = replayed(folder.log());
  EXPECT_EQ(replay.log().truncated, "");
  EXPECT_EQ(replay.mismatch(), "");
  EXPECT_EQ(replay.compared(), 2U);
}

}  // namespace
}  // namespace angen::record
