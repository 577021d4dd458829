#include "sim/command_queue.h"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>

#include "sdf/load.h"

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
  std::future<Outcome> deleted = queue->post(Delete{"box"});
  std::future<Outcome> again = queue->post(Delete{"box"});
  EXPECT_FALSE(building.models().empty());
  drain();
  EXPECT_TRUE(building.models().empty());
  EXPECT_FALSE(is_ready(deleted));
  queue->answer();
  EXPECT_TRUE(deleted.get().ok);
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

TEST_F(Queue, PauseItsEndAndResetInterruptSteps) {
  for (const Action& action : {Action(Pause{true}), Action(Pause{false}), Action(Reset{})}) {
    queue->post(Pause{true});
    drain();
    std::future<Outcome> first = queue->post(Step{4'000'000'000});
    std::future<Outcome> second = queue->post(Step{5});
    drain();
    queue->ticks_done(300);
    queue->post(action);
    drain();
    EXPECT_EQ(queue->ticks_to_go(), INT64_MAX);
    queue->answer();
    const Outcome outcome = first.get();
    EXPECT_FALSE(outcome.ok);
    EXPECT_EQ(outcome.ticks, 300U);
    EXPECT_NE(outcome.message.find("after 300 of 4000000000 ticks"), std::string::npos);
    EXPECT_EQ(second.get().ticks, 0U);
  }
}

TEST_F(Queue, WhatIsWithdrawnHasNoEffect) {
  const auto ticket = std::make_shared<Ticket>();
  std::future<Outcome> deleted = queue->post(Delete{"box"}, ticket);
  EXPECT_TRUE(ticket->withdraw());
  drain();
  queue->answer();
  EXPECT_FALSE(deleted.get().ok);
  EXPECT_FALSE(building.models().empty());
  EXPECT_TRUE(events.empty());
}

TEST_F(Queue, WhatHasBegunCannotBeWithdrawn) {
  const auto ticket = std::make_shared<Ticket>();
  queue->post(Delete{"box"}, ticket);
  drain();
  EXPECT_FALSE(ticket->withdraw());
  EXPECT_TRUE(building.models().empty());
}

TEST_F(Queue, AWithdrawnStepEndsWithTheTickThatIsTaken) {
  const auto ticket = std::make_shared<Ticket>();
  std::future<Outcome> step = queue->post(Step{1000}, ticket);
  drain();
  queue->ticks_done(7);
  EXPECT_FALSE(ticket->withdraw());
  drain();
  queue->answer();
  EXPECT_EQ(step.get().ticks, 7U);
  EXPECT_EQ(queue->ticks_to_go(), INT64_MAX);
}

TEST_F(Queue, LongTextsAreCutWhereTheyAreRepeated) {
  const std::string longest(1'000'000, 'x');
  std::future<Outcome> unknown = queue->post(ToDevice{longest, longest, {longest, {}, "", 0.0}});
  queue->post(Note{longest, longest, longest, longest});
  queue->post(Reject{longest, longest, longest});
  drain();
  queue->answer();
  EXPECT_LT(unknown.get().message.size(), 1000U);
  ASSERT_EQ(events.size(), 3U);
  for (const Event& event : events) {
    EXPECT_LT(event.source.size() + event.kind.size() + event.event.size(), 900U);
    EXPECT_LT(event.detail.size(), 2100U);
    EXPECT_NE(event.source.find("(1000000 bytes)"), std::string::npos);
  }
}

TEST_F(Queue, RejectsWhatIsMoreThanItsBytes) {
  const std::string long_text(1U << 20U, 'x');
  std::vector<std::future<Outcome>> answers;
  for (int i = 0; i < 40; ++i) answers.push_back(queue->post(Note{"a", "b", "c", long_text}));
  EXPECT_FALSE(is_ready(answers.front()));
  ASSERT_TRUE(is_ready(answers.back()));
  EXPECT_FALSE(answers.back().get().ok);
  drain();
  ASSERT_EQ(events.size(), 16U);
  EXPECT_EQ(events.back().event, "rejected");
  EXPECT_EQ(events.back().detail, "25 commands were rejected: more than 16 MB of them waited");
  std::future<Outcome> later = queue->post(Note{"a", "b", "c", "d"});
  drain();
  queue->answer();
  EXPECT_TRUE(later.get().ok);
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

/// Notes the commands that it gets.
class Listener : public Device {
 public:
  explicit Listener(std::vector<Command>& got) : got_(got) {}
  void configure(Params&, Wiring&) override {}
  Verdict command(const Command& command, const View&) override {
    got_.push_back(command);
    return Verdict::accept();
  }
  void update(const View&, Outputs&) override {}
  void report(const View&, Reading&) const override {}

 private:
  std::vector<Command>& got_;
};

class ListenerPlugin : public Plugin {
 public:
  const Kind& kind() const override { return kind_; }
  bool serves(const ModelInfo&) const override { return true; }
  std::unique_ptr<Device> make_device() const override { return std::make_unique<Listener>(got); }
  mutable std::vector<Command> got;

 private:
  Kind kind_ = Kind("lift", "").counted_verb("Floor", "floor", {0.0, 9.0}, "");
};

/// A queue and a building of some lifts.
class Lifts : public ::testing::Test {
 protected:
  void build(int count) {
    std::string models;
    for (int i = 0; i < count; ++i) {
      models += "<model name='lift" + std::to_string(i) +
                "'><link name='link'/><plugin name='l' filename='lift.so'/></model>";
    }
    const auto catalog = std::make_shared<Catalog>();
    catalog->add("lift.so", plugin);
    world = load::world_from_text("<sdf version='1.6'><world name='w'>" + models + "</world></sdf>",
                                  "test", {});
    building.emplace(world, 0, catalog);
  }
  Outcome command(const std::string& name, const std::string& text) {
    std::future<Outcome> answer = queue.post(ToDevice{"lift", name, {text}});
    queue.drain(*building, {}, events);
    queue.answer();
    return answer.get();
  }

  std::shared_ptr<ListenerPlugin> plugin = std::make_shared<ListenerPlugin>();
  desc::World world;
  std::optional<Building> building;
  std::vector<Event> events;
  CommandQueue queue;
};

TEST_F(Lifts, AllGetTheParsedCommand) {
  build(3);
  EXPECT_TRUE(command("all", "floor2").ok);
  ASSERT_EQ(plugin->got.size(), 3U);
  for (const Command& got : plugin->got) {
    EXPECT_EQ(got.verb, "Floor");
    EXPECT_EQ(got.number, 2.0);
  }
}

TEST_F(Lifts, ATextThatDoesNotFitReachesNone) {
  build(2);
  for (const char* text : {"", "Floor", "FloorX", "Floor-1", "Floor1.5", "Up", "Floor1 2",
                           "Floor99999999999999999999"}) {
    const Outcome outcome = command("all", text);
    EXPECT_FALSE(outcome.ok) << text;
    EXPECT_NE(outcome.message.find("a lift takes Floor<0 to 9 floor>; none of the others"),
              std::string::npos)
        << outcome.message;
  }
  EXPECT_TRUE(plugin->got.empty());
  EXPECT_EQ(events.back().event, "rejected");
}

TEST_F(Lifts, TheOnlyOneNeedsNoName) {
  build(1);
  EXPECT_TRUE(command("", "Floor2").ok);
  EXPECT_EQ(plugin->got.size(), 1U);
}

TEST_F(Lifts, OneOfSeveralNeedsAName) {
  build(2);
  EXPECT_EQ(command("", "Floor2").message, "no name; names are lift0, lift1");
  build(0);
  EXPECT_EQ(command("", "Floor2").message, "there is no lift");
  EXPECT_TRUE(plugin->got.empty());
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
