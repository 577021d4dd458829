#include "ros/inbox.h"

#include <gtest/gtest.h>

#include <thread>

#include "sdf/load.h"

namespace angen::node {
namespace {

using std::chrono::milliseconds;

/// Its command blocks until the test continues it.
class SlowDevice : public Device {
 public:
  struct Gate {
    std::promise<void> open;
  };

  explicit SlowDevice(std::shared_ptr<Gate> gate) : gate_(std::move(gate)) {}
  void configure(Params&, Wiring&) override {}
  Verdict command(const Command&, const View&) override {
    gate_->open.get_future().wait();
    return Verdict::accept([] {});
  }
  void update(const View&, Outputs&) override {}
  void report(const View&, Reading&) const override {}

 private:
  std::shared_ptr<Gate> gate_;
};

class SlowPlugin : public Plugin {
 public:
  explicit SlowPlugin(std::shared_ptr<SlowDevice::Gate> gate)
      : kind_("slow", "waits"), gate_(std::move(gate)) {
    kind_.verb("Go", "");
  }
  const Kind& kind() const override { return kind_; }
  bool serves(const ModelInfo&) const override { return true; }
  std::unique_ptr<Device> make_device() const override {
    return std::make_unique<SlowDevice>(gate_);
  }

 private:
  Kind kind_;
  std::shared_ptr<SlowDevice::Gate> gate_;
};

class InboxTest : public ::testing::Test {
 protected:
  InboxTest() {
    auto catalog = std::make_shared<Catalog>();
    catalog->add("libslow.so", std::make_shared<SlowPlugin>(gate));
    simulation.emplace(load::world_from_text(R"(<sdf version="1.6"><world name="w">
        <model name="box"><static>true</static><link name="link"/>
        <plugin name="p" filename="libslow.so"/></model></world></sdf>)",
                                             "test", {}),
                       1, catalog);
    inbox.emplace(*simulation, milliseconds(200));
  }

  std::size_t models() { return simulation->snapshot()->structure->models.size(); }

  std::shared_ptr<SlowDevice::Gate> gate = std::make_shared<SlowDevice::Gate>();
  std::optional<sim::Simulation> simulation;
  std::optional<Inbox> inbox;
};

TEST_F(InboxTest, ACallThatHasGivenUpHasNoEffect) {
  const sim::Outcome outcome = inbox->call(sim::Delete{"box"});  // without a tick
  EXPECT_FALSE(outcome.ok);
  EXPECT_EQ(outcome.message, "the simulation did not answer within 0.2 s; nothing was done");
  const auto after = simulation->tick();
  EXPECT_EQ(models(), 1U);
  EXPECT_TRUE(after->events.empty());
}

TEST_F(InboxTest, ACallThatIsBeingCarriedOutSaysSo) {
  std::atomic<bool> done{false};
  std::thread ticking([&] {
    while (!done) simulation->tick();
  });
  sim::Outcome outcome;
  std::thread calling([&] {
    outcome = inbox->call(sim::ToDevice{"slow", "box", {"Go", {}, "", 0.0}});
  });
  calling.join();
  done = true;
  gate->open.set_value();
  ticking.join();
  EXPECT_FALSE(outcome.ok);
  EXPECT_NE(outcome.message.find("it has begun, and takes effect"), std::string::npos);
}

TEST_F(InboxTest, AStepWhoseClientIsLostEnds) {
  std::atomic<bool> lost{false};
  std::atomic<bool> answered{false};
  sim::Outcome outcome;
  std::thread calling([&] {
    outcome = inbox->call(sim::Step{UINT64_MAX}, [&] { return lost.load(); });
    answered = true;
  });
  for (int i = 0; !answered; ++i) {
    simulation->tick();
    inbox->published();
    if (i == 300) lost = true;
    std::this_thread::sleep_for(milliseconds(1));
  }
  calling.join();
  EXPECT_FALSE(outcome.ok);
  EXPECT_GE(outcome.ticks, 100U);
  EXPECT_LT(outcome.ticks, 100'000U);
}

}  // namespace
}  // namespace angen::node
