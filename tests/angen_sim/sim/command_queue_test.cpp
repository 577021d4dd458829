#include "sim/command_queue.h"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>

#include "load/load.h"

namespace angen::sim {
namespace {

bool is_ready(const std::future<Outcome>& future) {
  return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

/// A queue and a building of one box.
class Queue : public ::testing::Test {
 protected:
  CommandQueue::Effects drain() { return queue->drain(building, {}, events); }

  desc::World world = load::world_from_text(R"(<sdf version="1.6"><world name="w">
      <model name="box"><link name="link"/></model></world></sdf>)",
                                            "test", {});
  Building building{world, 0, std::make_shared<Catalog>()};
  std::vector<Event> events;
  std::optional<CommandQueue> queue{std::in_place};
};

TEST_F(Queue, ExecutesInOrderAndAnswersAfterTheSnapshot) {
  std::future<Outcome> gone = queue->post(Delete{"box"});
  std::future<Outcome> again = queue->post(Delete{"box"});
  EXPECT_FALSE(building.models().empty());
  drain();
  EXPECT_TRUE(building.models().empty());
  EXPECT_FALSE(is_ready(gone));
  queue->answer();
  EXPECT_TRUE(gone.get().ok);
  EXPECT_FALSE(again.get().ok);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].event, "deleted");
  EXPECT_EQ(events[1].event, "rejected");
}

TEST_F(Queue, StepsRunOneAfterTheOtherWhilePaused) {
  queue->post(Pause{true});
  drain();
  EXPECT_FALSE(queue->running());
  EXPECT_EQ(queue->ticks_to_go(), INT64_MAX);
  std::future<Outcome> first = queue->post(Step{3});
  std::future<Outcome> second = queue->post(Step{2});
  drain();
  EXPECT_TRUE(queue->running());
  EXPECT_EQ(queue->ticks_to_go(), 3);
  queue->ticks_done(3);
  queue->answer();
  EXPECT_TRUE(is_ready(first));
  EXPECT_FALSE(is_ready(second));
  EXPECT_EQ(queue->ticks_to_go(), 2);
  queue->ticks_done(2);
  queue->answer();
  EXPECT_TRUE(second.get().ok);
  EXPECT_FALSE(queue->running());
}

TEST_F(Queue, SaysWhatItsCallerMustDo) {
  queue->post(Reset{true});
  queue->post(Reset{false});
  const auto into = std::make_shared<SavedState>();
  queue->post(Save{into});
  queue->post(Reject{"door", "kitchen0", "no such verb"});
  const CommandQueue::Effects effects = drain();
  EXPECT_TRUE(effects.reset && effects.reset_time);
  EXPECT_FALSE(effects.commanded);
  EXPECT_EQ(effects.saves, std::vector<std::shared_ptr<SavedState>>{into});
  EXPECT_EQ(events.back().detail, "no such verb");
  queue->post(ToDevice{"door", "nothing", {}});
  EXPECT_TRUE(drain().commanded);
}

TEST_F(Queue, WhatStillWaitsAtItsEndIsAnswered) {
  std::future<Outcome> step = queue->post(Step{1});
  drain();
  std::future<Outcome> waiting = queue->post(Delete{"box"});
  queue.reset();
  EXPECT_FALSE(step.get().ok);
  EXPECT_EQ(waiting.get().message, "the simulator ended");
}

}  // namespace
}  // namespace angen::sim
