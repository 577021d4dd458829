#pragma once

namespace angen::load {

/// The body of an <actor>, and the plug-in that walks it. describe_actor() adds the actor's own
/// mass, temperatures and waypoints. The moments are those of a solid cylinder of a person's size.
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
    <visual name="legs">
      <pose>0 0 0.43 0 0 0</pose>
      <geometry><cylinder><radius>0.16</radius><length>0.86</length></cylinder></geometry>
      <material><diffuse>0.22 0.22 0.26 1</diffuse></material>
    </visual>
    <visual name="torso">
      <pose>0 0 1.12 0 0 0</pose>
      <geometry><capsule><radius>0.22</radius><length>0.26</length></capsule></geometry>
      <material><diffuse>0.20 0.36 0.60 1</diffuse></material>
    </visual>
    <visual name="head">
      <pose>0 0 1.62 0 0 0</pose>
      <geometry><sphere><radius>0.13</radius></sphere></geometry>
      <material><diffuse>0.85 0.65 0.53 1</diffuse></material>
    </visual>
    <visual name="face">
      <pose>0.14 0 1.62 0 0 0</pose>
      <geometry><box><size>0.06 0.04 0.04</size></box></geometry>
      <material><diffuse>0.85 0.65 0.53 1</diffuse></material>
    </visual>
  </link>
  <plugin name="person" filename="libperson_controller.so"/>
</model>
)";

}  // namespace angen::load
