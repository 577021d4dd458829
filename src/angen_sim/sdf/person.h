#pragma once

namespace angen::load {

/// The body of an <actor>, and the plug-in that walks it. describe_actor() adds the actor's own
/// mass, temperatures and waypoints. The moments are those of a solid cylinder of a person's size.
/// The plug-in moves the limbs by the names of their visuals.
constexpr char kPerson[] = R"(
<model name="person">
  <link name="body">
    <inertial>
      <pose>0 0 0.875 0 0 0</pose>
      <mass>70</mass>
      <inertia>
        <ixx>18.958333333333332</ixx>
        <iyy>18.958333333333332</iyy>
        <izz>2.1875</izz>
      </inertia>
    </inertial>
    <collision name="collision">
      <pose>0 0 0.875 0 0 0</pose>
      <geometry><capsule><radius>0.25</radius><length>1.25</length></capsule></geometry>
      <!-- the person's motor moves it, not its soles -->
      <surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface>
    </collision>
    <!-- when it sits or lies: from the seat or the bed up, x ahead -->
    <collision name="sit_thighs"><pose>0.15 0 0.07 0 0 0</pose><geometry><box><size>0.54 0.34 0.14</size></box></geometry>
      <surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface></collision>
    <collision name="sit_trunk"><pose>-0.02 0 0.38 0 0 0</pose><geometry><box><size>0.2 0.48 0.48</size></box></geometry>
      <surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface></collision>
    <collision name="sit_shanks"><pose>0.37 0 -0.19 0 0 0</pose><geometry><box><size>0.1 0.31 0.38</size></box></geometry>
      <surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface></collision>
    <collision name="lie_legs"><pose>-0.44 0 0.07 0 0 0</pose><geometry><box><size>0.82 0.3 0.14</size></box></geometry>
      <surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface></collision>
    <collision name="lie_trunk"><pose>0.24 0 0.09 0 0 0</pose><geometry><box><size>0.54 0.48 0.18</size></box></geometry>
      <surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface></collision>
    <collision name="sit_head"><pose>-0.02 0 0.75 0 0 0</pose><geometry><sphere><radius>0.11</radius></sphere></geometry>
      <surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface></collision>
    <collision name="lie_head"><pose>0.64 0 0.2 0 0 0</pose><geometry><sphere><radius>0.11</radius></sphere></geometry>
      <surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface></collision>
    <visual name="thigh_left">
      <pose>0 0.09 0.685 0 0 0</pose>
      <geometry><capsule><radius>0.08</radius><length>0.43</length></capsule></geometry>
      <material><diffuse>0.22 0.22 0.26 1</diffuse></material>
    </visual>
    <visual name="shank_left">
      <pose>0 0.09 0.28 0 0 0</pose>
      <geometry><capsule><radius>0.058</radius><length>0.38</length></capsule></geometry>
      <material><diffuse>0.22 0.22 0.26 1</diffuse></material>
    </visual>
    <visual name="foot_left">
      <pose>0.05 0.09 0.035 0 0 0</pose>
      <geometry><box><size>0.25 0.09 0.07</size></box></geometry>
      <material><diffuse>0.12 0.12 0.13 1</diffuse></material>
    </visual>
    <visual name="upper_arm_left">
      <pose>0 0.22 1.27 0 0 0</pose>
      <geometry><capsule><radius>0.05</radius><length>0.3</length></capsule></geometry>
      <material><diffuse>0.20 0.36 0.60 1</diffuse></material>
    </visual>
    <visual name="forearm_left">
      <pose>0 0.22 0.99 0 0 0</pose>
      <geometry><capsule><radius>0.042</radius><length>0.26</length></capsule></geometry>
      <material><diffuse>0.85 0.65 0.53 1</diffuse></material>
    </visual>
    <visual name="thigh_right">
      <pose>0 -0.09 0.685 0 0 0</pose>
      <geometry><capsule><radius>0.08</radius><length>0.43</length></capsule></geometry>
      <material><diffuse>0.22 0.22 0.26 1</diffuse></material>
    </visual>
    <visual name="shank_right">
      <pose>0 -0.09 0.28 0 0 0</pose>
      <geometry><capsule><radius>0.058</radius><length>0.38</length></capsule></geometry>
      <material><diffuse>0.22 0.22 0.26 1</diffuse></material>
    </visual>
    <visual name="foot_right">
      <pose>0.05 -0.09 0.035 0 0 0</pose>
      <geometry><box><size>0.25 0.09 0.07</size></box></geometry>
      <material><diffuse>0.12 0.12 0.13 1</diffuse></material>
    </visual>
    <visual name="upper_arm_right">
      <pose>0 -0.22 1.27 0 0 0</pose>
      <geometry><capsule><radius>0.05</radius><length>0.3</length></capsule></geometry>
      <material><diffuse>0.20 0.36 0.60 1</diffuse></material>
    </visual>
    <visual name="forearm_right">
      <pose>0 -0.22 0.99 0 0 0</pose>
      <geometry><capsule><radius>0.042</radius><length>0.26</length></capsule></geometry>
      <material><diffuse>0.85 0.65 0.53 1</diffuse></material>
    </visual>
    <visual name="trunk">
      <pose>0 0 1.15 0 0 0</pose>
      <geometry><capsule><radius>0.17</radius><length>0.36</length></capsule></geometry>
      <material><diffuse>0.20 0.36 0.60 1</diffuse></material>
    </visual>
    <visual name="neck">
      <pose>0 0 1.5 0 0 0</pose>
      <geometry><cylinder><radius>0.055</radius><length>0.12</length></cylinder></geometry>
      <material><diffuse>0.85 0.65 0.53 1</diffuse></material>
    </visual>
    <visual name="head">
      <pose>0 0 1.635 0 0 0</pose>
      <geometry><sphere><radius>0.115</radius></sphere></geometry>
      <material><diffuse>0.85 0.65 0.53 1</diffuse></material>
    </visual>
    <visual name="hair">
      <pose>-0.02 0 1.645 0 0 0</pose>
      <geometry><sphere><radius>0.113</radius></sphere></geometry>
      <material><diffuse>0.25 0.18 0.14 1</diffuse></material>
    </visual>
    <visual name="nose">
      <pose>0.115 0 1.625 0 0 0</pose>
      <geometry><sphere><radius>0.02</radius></sphere></geometry>
      <material><diffuse>0.85 0.65 0.53 1</diffuse></material>
    </visual>
  </link>
  <plugin name="person" filename="libperson_controller.so"/>
</model>
)";

}  // namespace angen::load
