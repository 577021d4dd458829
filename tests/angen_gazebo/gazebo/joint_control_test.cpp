#include "gazebo/joint_control.h"

#include <gtest/gtest.h>

#include <cmath>

#include "angen_gazebo/robots/robot.h"
#include "document/xml.h"

namespace angen::node {
namespace {

/// The actions of a control in these tests on its joints.
using Law = std::function<void(double time, std::vector<ControlledJoint>& joints)>;
Law law;
std::string made_in;
int alive = 0;

class LawControl : public JointControl {
 public:
  LawControl() { ++alive; }
  ~LawControl() override { --alive; }
  void update(Nanoseconds time, std::vector<ControlledJoint>& joints) override {
    law(to_seconds(time), joints);
  }
};

const JointControlRegistration registration("libgazebo_ros_control.so",
                                            [](const Element&, const std::string& space,
                                               const std::vector<ControlledJoint>&) {
                                              made_in = space;
                                              return std::make_unique<LawControl>();
                                            });

std::string transmission(const std::string& joint, const std::string& interface) {
  return "<transmission><joint>" + joint + "</joint><hardwareInterface>hardware_interface/" +
         interface + "JointInterface</hardwareInterface></transmission>";
}

std::string control(const std::string& interface) {
  return "<plugin name='c' filename='libgazebo_ros_control.so'><robotNamespace>/bot/arm"
         "</robotNamespace>" +
         transmission("left_joint", interface) + transmission("no_joint", interface) + "</plugin>";
}

/// Two arms in the air, and their controls.
struct Arms {
  explicit Arms(const std::string& interface) : hall(robots::arms(control(interface)), true) {
    controls.on_structure(*hall.snapshot->structure,
                          changes_between(nullptr, *hall.snapshot->structure));
    hall.simulation.observe([this](const sim::Action&, Nanoseconds) { ++commands; }, {});
  }
  /// The largest distance of the left arm from `target`.
  double run(double seconds, const std::function<double(double)>& target) {
    double worst = 0.0;
    for (int i = 0; i < std::lround(1000 * seconds); ++i) {
      controls.update(*hall.snapshot);
      hall.snapshot = hall.simulation.tick();
      const double off = position() - target(to_seconds(hall.snapshot->time));
      worst = std::max(worst, std::abs(off));
    }
    return worst;
  }
  double position() const {
    const auto& joints = hall.snapshot->structure->joints;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      if (joints[i].name == "bot::left_joint") return hall.snapshot->joint_positions[i];
    }
    return NAN;
  }

  robots::Hall hall;
  JointControls controls{hall.simulation};
  int commands = 0;
};

double wave(double time) { return 0.5 * (1.0 - std::cos(2.0 * time)); }

TEST(JointControl, TheNamespaceIsTheElementsTextOrTheModelsName) {
  const auto space = [](const std::string& inner) {
    return control_space(load::parse_xml("<plugin>" + inner + "</plugin>", "p.xml"), "bot");
  };
  EXPECT_EQ(space(""), "/bot");
  EXPECT_EQ(space("<robotNamespace/>"), "/");
  EXPECT_EQ(space("<robotNamespace></robotNamespace>"), "/");
  EXPECT_EQ(space("<robotNamespace>left</robotNamespace>"), "/left");
}

TEST(JointControl, PositionsOfEachTickAreFollowed) {
  Arms arms("Position");
  EXPECT_EQ(made_in, "/bot/arm");
  law = [](double time, std::vector<ControlledJoint>& joints) {
    ASSERT_EQ(joints.size(), 1U) << "a name without a joint in the model is left out";
    joints[0].command = wave(time);
  };
  EXPECT_LT(arms.run(4.0, wave), 0.003);
}

TEST(JointControl, AnEffortFeelsTheJointsSpeed) {
  Arms arms("Effort");
  law = [](double, std::vector<ControlledJoint>& joints) {
    const double weight = -0.2 * 9.8 * std::cos(joints[0].position);
    joints[0].command = 20.0 * (0.5 - joints[0].position) - 2.0 * joints[0].velocity + weight;
  };
  arms.run(3.0, wave);
  // Critically damped but for the weight that it compensates: it neither swings nor is off.
  EXPECT_LT(arms.run(1.0, [](double) { return 0.5; }), 0.001);
}

TEST(JointControl, OnlyChangesAreQueued) {
  Arms arms("Position");
  law = [](double, std::vector<ControlledJoint>&) {};
  arms.run(0.1, wave);
  EXPECT_EQ(arms.commands, 0) << "no command yet";
  law = [](double, std::vector<ControlledJoint>& joints) { joints[0].command = 0.25; };
  arms.run(1.0, wave);
  EXPECT_EQ(arms.commands, 1);
  arms.hall.simulation.post(sim::Reset{false});
  EXPECT_LT(arms.run(1.0, [](double) { return 0.25; }), 0.26);
  EXPECT_EQ(arms.commands, 3) << "a reset forgets commands";
  EXPECT_NEAR(arms.position(), 0.25, 0.001);
}

TEST(JointControl, ControlsGoWithTheirModel) {
  Arms arms("Position");
  law = [](double, std::vector<ControlledJoint>&) {};
  EXPECT_EQ(alive, 1);
  const auto before = arms.hall.snapshot->structure;
  arms.hall.simulation.post(sim::Delete{"bot"});
  arms.hall.snapshot = arms.hall.simulation.tick();
  const auto& now = *arms.hall.snapshot->structure;
  arms.controls.on_structure(now, changes_between(before.get(), now));
  EXPECT_TRUE(arms.controls.empty());
  EXPECT_EQ(alive, 0);
}

}  // namespace
}  // namespace angen::node
