#include "sim/simulation.h"

#include <gtest/gtest.h>

#include <thread>

#include "angen_sim/sim/room.h"

namespace angen::sim {
namespace {

std::unique_ptr<Simulation> floor_only() {
  return simulation_of(
      in_world("<model name='floor'><static>true</static><link name='link'/></model>"));
}

bool ready(const std::future<Outcome>& future) {
  return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

TEST(Simulation, PausedTimeStandsStillAndCommandsAreStillAnswered) {
  const auto simulation = floor_only();
  simulation->post(Pause{true});
  simulation->tick();
  std::future<Outcome> rejected = simulation->post(Delete{"nothing"});
  EXPECT_EQ(simulation->tick()->time, 0);
  ASSERT_TRUE(ready(rejected));
  EXPECT_FALSE(rejected.get().ok);
}

TEST(Simulation, ANoteBecomesAnEventOfThatTick) {
  const auto simulation = floor_only();
  simulation->tick();
  std::future<Outcome> noted = simulation->post(Note{"clock", "test", "struck", "twelve"});
  const auto snapshot = simulation->tick();
  ASSERT_EQ(snapshot->events.size(), 1U);
  const Event& event = snapshot->events.front();
  EXPECT_EQ(event.source, "clock");
  EXPECT_EQ(event.kind, "test");
  EXPECT_EQ(event.event, "struck");
  EXPECT_EQ(event.detail, "twelve");
  EXPECT_EQ(event.stamp, snapshot->step);
  ASSERT_TRUE(ready(noted));
  EXPECT_TRUE(noted.get().ok);
}

TEST(Simulation, BodiesInOnePlaceAreToldOnce) {
  std::string models;
  for (int i = 0; i < 230; ++i) {
    models += "<model name='m" + std::to_string(i) +
              "'><link name='l'><collision name='c'><geometry><box><size>0.1 0.1 0.1</size></box>"
              "</geometry></collision></link></model>";
  }
  const auto simulation = simulation_of(in_world(models));
  const auto first = simulation->tick();
  ASSERT_EQ(first->events.size(), 1U);
  EXPECT_EQ(first->events[0].event, "crowded");
  EXPECT_EQ(first->events[0].stamp, first->step);
  EXPECT_TRUE(simulation->tick()->events.empty());
}

TEST(Simulation, CommandsFromManyThreadsAreEachAnsweredOnce) {
  const auto simulation = floor_only();
  std::vector<std::thread> threads;
  std::vector<std::future<Outcome>> answers(80);
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 20; ++i) {
        answers[static_cast<std::size_t>(20 * t + i)] = simulation->post(Delete{"nothing"});
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(simulation->tick()->events.size(), 80U);
  for (std::future<Outcome>& answer : answers) EXPECT_FALSE(answer.get().ok);
}

TEST(Simulation, ASnapshotThatIsKeptDoesNotChange) {
  const auto simulation = floor_only();
  const auto before = simulation->tick();
  simulation->post(Delete{"floor"});
  simulation->tick();
  EXPECT_EQ(before->structure->models.size(), 1U);
  EXPECT_EQ(before->link_poses.size(), 1U);
  EXPECT_TRUE(simulation->snapshot()->structure->models.empty());
}

TEST(Simulation, ATimeIsTicksTimesStepExactly) {
  const auto simulation = floor_only();
  for (int i = 0; i < 12345; ++i) simulation->tick();
  EXPECT_EQ(simulation->snapshot()->time, 12345 * simulation->world().physics.step);
}

}  // namespace
}  // namespace angen::sim
