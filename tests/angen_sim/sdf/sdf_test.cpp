#include "angen_sim/sdf/texts.h"

namespace angen::load {
namespace {

// libsdformat gets a schema without the parts that the document lacks; it must not miss any of
// them. Whether each of these loads or is rejected matters less than that both come back.
void expect_no_crash(const std::string& text) {
  SCOPED_TRACE(text);
  try {
    read(text);
  } catch (const Error& error) {
    EXPECT_STRNE(error.what(), "");
  }
}

std::string in_geometry(const std::string& shape) {
  return in_link("<visual name='v'><geometry>" + shape + "</geometry></visual>");
}

TEST(Schema, ACameraSensorNeedsNoCamera) {
  EXPECT_NO_THROW(read(in_link("<sensor name='lux' type='camera'/>")));
}

TEST(Schema, HasWhatASensorOfEachTypeAsksFor) {
  for (const std::string type : {"air_pressure",
                                 "altimeter",
                                 "boundingbox_camera",
                                 "camera",
                                 "contact",
                                 "custom",
                                 "depth",
                                 "depth_camera",
                                 "force_torque",
                                 "gps",
                                 "gpu_lidar",
                                 "gpu_ray",
                                 "imu",
                                 "lidar",
                                 "logical_camera",
                                 "magnetometer",
                                 "multicamera",
                                 "navsat",
                                 "ray",
                                 "rfid",
                                 "rfidtag",
                                 "rgbd",
                                 "rgbd_camera",
                                 "segmentation_camera",
                                 "sonar",
                                 "thermal",
                                 "thermal_camera",
                                 "wideanglecamera",
                                 "wireless_receiver",
                                 "wireless_transmitter"}) {
    expect_no_crash(in_link("<sensor name='s' type='" + type + "'/>"));
  }
}

TEST(Schema, HasWhatEmptyElementsAskFor) {
  for (const char* const shape : {"<empty/>", "<box/>", "<sphere/>", "<cylinder/>", "<capsule/>",
                                  "<plane/>", "<mesh/>", "<heightmap/>"}) {
    expect_no_crash(in_geometry(shape));
  }
  const std::string sphere = "<geometry><sphere><radius>1</radius></sphere></geometry>";
  for (const char* const part : {"", "<material/>", "<meta/>", "<plugin filename='x' name='x'/>"}) {
    expect_no_crash(in_link("<visual name='v'>" + sphere + part + "</visual>"));
  }
  for (const char* const part :
       {"", "<surface/>", "<surface><friction/></surface>", "<surface><contact/></surface>",
        "<surface><bounce/></surface>", "<surface><friction><ode/></friction></surface>"}) {
    expect_no_crash(in_link("<collision name='c'>" + sphere + part + "</collision>"));
  }
  for (const char* const type : {"point", "spot", "directional"}) {
    const std::string light = "<light name='l' type='" + std::string(type) + "'/>";
    expect_no_crash(in_link(light));
    expect_no_crash(in_world(light));
  }
  for (const char* const type : {"fixed", "revolute", "prismatic", "ball", "universal"}) {
    for (const char* const axis :
         {"", "<axis><xyz>0 0 1</xyz></axis>",
          "<axis><xyz>0 0 1</xyz></axis><axis2><xyz>1 0 0</xyz></axis2>"}) {
      expect_no_crash(in_model(two_links() + "<joint name='j' type='" + type +
                               "'><parent>a</parent><child>b</child>" + axis + "</joint>"));
    }
  }
  for (const char* const part :
       {"<scene/>", "<physics type='ode'/>", "<atmosphere type='adiabatic'/>", "<wind/>",
        "<spherical_coordinates/>", "<gui/>", "<audio/>"}) {
    expect_no_crash(in_world(part));
  }
  for (const char* const part : {"<inertial/>", "<battery name='b'/>", "<projector name='p'/>",
                                 "<audio_source/>", "<audio_sink/>",
                                 "<particle_emitter name='p' "
                                 "type='point'/>"}) {
    expect_no_crash(in_link(part));
  }
}

TEST(Schema, StillTellsWhatItDoesNotKnow) {
  const desc::World one =
      read(in_link("<visual name='v'><geometry><sphere><radius>2</radius>"
                   "</sphere></geometry></visual>"));
  EXPECT_EQ(one.models.at(0).links.at(0).visuals.at(0).shape.radius, 2.0);
  EXPECT_TRUE(one.warnings.empty());
  const desc::World odd =
      read(in_link("<visual name='v'><geometry><sphere><radius>2</radius>"
                   "</sphere></geometry><surface/></visual>"));
  ASSERT_EQ(odd.warnings.size(), 1U) << "an element at the wrong place stays a warning";
}

}  // namespace
}  // namespace angen::load
