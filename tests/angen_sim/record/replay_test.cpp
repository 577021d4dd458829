#include "record/replay.h"

#include <filesystem>
#include <fstream>

#include "angen_sim/record/logged.h"

namespace angen::record {
namespace {

void live_a_little(Session& session) {
  sim::Simulation& simulation = *session;
  session.run(0.5);
  session.command("lamp", "hall0", "On");
  session.command("door", "hall0", "Open");
  session.run(2.3);
  simulation.post(crate("one", 0.7, 2.0));
  simulation.post(crate("two", -0.7, 1.0));
  session.run(1.7);
  simulation.post(sim::Note{"program", "care", "noticed", "a \"quote\", \x01 and \xff"});
  simulation.post(sim::Attach{
      load::sensor(sim::custom("air", "temperature_sensor", "<noise_stddev>0.1</noise_stddev>"),
                   "air", Pose{{0.1, 0, 0.2}, Quat::Identity()}),
      "one::link"});
  session.command("lamp", "hall0", "Fly");  // rejected
  session.run(0.4);
  simulation.post(sim::Delete{"two"});
  simulation.post(sim::Pause{true});
  session.tick();
  session.tick();
  session.command("lamp", "hall0", "Dim 40");
  session.tick();
  simulation.post(sim::Step{250});
  session.run(0.25);
  session.tick();
  simulation.post(crate("three", 0.2, 3.0));
  session.tick();
  simulation.post(sim::Pause{false});
  session.run(3.0);
  simulation.post(sim::ToDevice{"heater", "stove", {"", {0.1 + 0.2}}});
  simulation.post(sim::Reset{true});
  session.run(2.5);
  simulation.post(sim::Reset{false});
  session.command("lamp", "hall0", "Off");
  session.run(7.0);
}

TEST(Replay, GivesTheSameFingerprintEverySecondLeapingOrNot) {
  const Folder folder;
  Session session(folder);
  live_a_little(session);
  session.end();
  for (const bool leap : {true, false}) {
    const Replay replay = replayed(folder.log(), {leap, true});
    EXPECT_EQ(replay.mismatch(), "") << leap;
    EXPECT_EQ(replay.compared(), 27U) << leap;  // 8 s, the reset, 17 s, the end
    EXPECT_EQ(replay.actions(), 17U) << leap;
    EXPECT_EQ(replay.log().truncated, "");
  }
}

TEST(Replay, FindsAnythingThatIsOtherwise) {
  const Folder folder;
  Session session(folder);
  live_a_little(session);
  session.end();
  const Log log = read_log(folder.log());
  const auto mismatch_without = [&](const auto& which) {
    Log changed = log;
    for (std::size_t i = 0; i < changed.entries.size(); ++i) {
      if (!which(changed.entries[i])) continue;
      changed.entries.erase(changed.entries.begin() + static_cast<std::ptrdiff_t>(i));
      break;
    }
    EXPECT_LT(changed.entries.size(), log.entries.size());
    Replay replay(changed, std::make_shared<Catalog>());
    while (!replay.done() && replay.mismatch().empty()) replay.advance();
    return replay.mismatch();
  };
  const auto spawn = [](const LogEntry& e) { return std::holds_alternative<SpawnText>(e.what); };
  const auto action = [](const LogEntry& e, auto is) {
    const auto* found = std::get_if<sim::Action>(&e.what);
    return found != nullptr && is(*found);
  };
  EXPECT_NE(mismatch_without(spawn).find("run.log:8: at 3.000000 s the fingerprint is "),
            std::string::npos)
      << mismatch_without(spawn);
  EXPECT_NE(mismatch_without([&](const LogEntry& e) {
              return action(
                  e, [](const sim::Action& a) { return std::holds_alternative<sim::Note>(a); });
            }),
            "");
  Log other = log;
  ++other.header.seed;
  Replay replay(other, std::make_shared<Catalog>());
  while (!replay.done() && replay.mismatch().empty()) replay.advance();
  EXPECT_NE(replay.mismatch(), "") << "of another seed";
}

TEST(Replay, DoesNotDependOnWhoListens) {
  std::string lidar = sim::body("scanner", "<box><size>0.1 0.1 0.1</size></box>", "-2 0 1 0 0 0",
                                true, sim::ray_sensor("scan", "libgazebo_ros_laser.so", 10, 0.01));
  const std::string rows = "<samples>3</samples>";
  lidar.replace(lidar.find(rows), rows.size(), "<samples>1</samples>");
  std::string sdf = sim::text_of_household();
  sdf.insert(sdf.find("</world>"), lidar);
  const Folder folder(sdf);
  Session session(folder);
  session.run(1.5);
  (*session).request("lidar", "scanner", true);
  session.run(2.0);
  (*session).request("lidar", "scanner", false);
  session.run(1.0);
  const std::uint64_t readings = (*session).snapshot()->counts.readings;
  session.end();
  const Log log = read_log(folder.log());
  EXPECT_EQ(std::count_if(
                log.entries.begin(), log.entries.end(),
                [](const LogEntry& e) { return std::holds_alternative<ReadingRequest>(e.what); }),
            2);
  Replay same = replayed(folder.log());
  EXPECT_EQ(same.mismatch(), "");
  EXPECT_EQ(same.simulation().snapshot()->counts.readings, readings) << "as many samples";
  Replay silent = replayed(folder.log(), {true, false});
  EXPECT_EQ(silent.mismatch(), "");
  EXPECT_LT(silent.simulation().snapshot()->counts.readings, readings);
  EXPECT_EQ(silent.compared(), same.compared());
}

TEST(Replay, EndsAStepThatWasWithdrawn) {
  const Folder folder;
  Session session(folder);
  (*session).post(sim::Pause{true});
  session.tick();
  const auto ticket = std::make_shared<sim::Ticket>();
  auto answer = (*session).post(sim::Step{5000}, ticket);
  session.run(1.2);
  ticket->withdraw();
  session.tick();
  EXPECT_NE(answer.get().message.find("stopped after 1200 of 5000"), std::string::npos);
  session.command("lamp", "hall0", "On");
  session.tick();
  (*session).post(sim::Pause{false});
  session.run(1.0);
  session.end();
  const Replay replay = replayed(folder.log());
  EXPECT_EQ(replay.mismatch(), "");
  EXPECT_EQ(replay.compared(), 3U);
}

TEST(Replay, StopsAtATimeAndGoesOnLive) {
  const Folder folder;
  Session session(folder);
  session.run(0.5);
  session.command("lamp", "hall0", "On");
  session.run(3.0);
  session.command("lamp", "hall0", "Off");
  session.run(3.0);
  session.end();
  Replay replay(read_log(folder.log()), std::make_shared<Catalog>());
  replay.stop_at(from_seconds(2.0005));
  auto answer = replay.simulation().post(sim::ToDevice{"lamp", "hall0", {"Off", {}}});
  while (!replay.done()) replay.advance();
  EXPECT_EQ(replay.simulation().snapshot()->time, from_seconds(2.001));
  EXPECT_EQ(answer.get().message,
            folder.log() + " is being replayed; commands are executed after it");
  const auto rejected = replay.simulation().tick()->events;
  ASSERT_EQ(rejected.size(), 1U);
  EXPECT_EQ(rejected[0].detail, "1 command was rejected: " + folder.log() +
                                    " is being replayed; commands are executed after it");
  auto taken = replay.simulation().post(sim::ToDevice{"lamp", "hall0", {"Dim 30", {}}});
  replay.simulation().tick();
  EXPECT_TRUE(taken.get().ok);
  EXPECT_EQ(replay.compared(), 2U);
}

TEST(Replay, SearchesOnlyTheModelsBesideAWorldThatIsHere) {
  const Folder folder;
  Session session(folder);
  session.run(1.0);
  session.end();
  Log log = read_log(folder.log());
  const auto models = [&] { return Replay(log, std::make_shared<Catalog>()).models(); };
  const std::string world = folder.log() + ".world";
  const std::string beside = std::filesystem::path(world).parent_path() / "models";
  for (const std::string& other : {std::string("/"), beside}) {
    log.header.world = world;
    log.header.models = other;
    EXPECT_EQ(models(), "") << "there is no such world";
  }
  std::ofstream(world) << "a world";
  EXPECT_EQ(models(), beside);
  log.header.models = "/";
  EXPECT_EQ(models(), "");
}

TEST(Replay, NeedsTheMeshesAsTheyWere) {
  const std::string stl =
      "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
      "vertex 0 1 0\nendloop\nendfacet\nendsolid s\n";
  std::string sdf = sim::text_of_household();
  sdf.insert(sdf.find("</world>"),
             sim::body("plate", "<mesh><uri>plate.stl</uri></mesh>", "1 1 1 0 0 0", true));
  const Folder folder(sdf);
  const std::string mesh = (folder.path / "plate.stl").string();
  write_all(mesh, stl);
  Session session(folder);
  session.run(1.5);
  session.end();
  EXPECT_EQ(replayed(folder.log()).mismatch(), "");
  const auto rejection = [&] {
    try {
      replayed(folder.log());
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  write_all(mesh, stl + " ");
  EXPECT_NE(rejection().find("run.log:1: needs the file file://" + mesh), std::string::npos)
      << rejection();
  EXPECT_NE(rejection().find("differs from it"), std::string::npos) << rejection();
  std::filesystem::remove(mesh);
  EXPECT_NE(rejection().find("it is missing"), std::string::npos) << rejection();
  const std::filesystem::path elsewhere = folder.path / "mail";
  std::filesystem::create_directories(elsewhere);
  std::filesystem::rename(folder.log(), elsewhere / "run.log");
  write_all((elsewhere / "plate.stl").string(), stl);
  EXPECT_EQ(replayed((elsewhere / "run.log").string()).mismatch(), "") << "beside the log";
}

}  // namespace
}  // namespace angen::record
