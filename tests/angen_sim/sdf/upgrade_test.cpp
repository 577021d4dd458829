#include "sdf/upgrade.h"

#include <algorithm>
#include <map>
#include <utility>

#include "angen_sim/sdf/texts.h"
#include "document/xml.h"

// SDF 1.0, in which values are attributes, is read as the SDF that has them in elements.
namespace angen::load {
namespace {

const char* const kInAttributes = R"(<gazebo version='1.0'>
<world name='w'>
<scene>
<ambient rgba='0.1 0.2 0.3 1'/>
<background rgba='0.4 0.5 0.6 1'><sky material='Gazebo/CloudySky'/></background>
<shadows enabled='false' rgba='0 0 0.5 0.5' type='texture_gpu'/>
<fog rgba='0 0 0.5 0.5' type='linear' start='2' end='10' density='0.5'/>
</scene>
<light type='spot' name='lamp' cast_shadows='false'>
<origin pose='0 0 8 0 0 0'/>
<diffuse rgba='1 0.5 0.5 1'/>
<specular rgba='0.1 0.1 0.1 1'/>
<attenuation range='20'/>
<direction xyz='0.5 0 -1'/>
</light>
<model name='m' static='false'>
<origin pose='1 2 3 0.1 0.2 0.3'/>
<link name='a' gravity='false' self_collide='true' kinematic='false'>
<origin pose='0 0 1 0 0 0'/>
<inertial mass='5'><origin pose='0 0 0.1 0 0 0'/><inertia ixx='1' ixy='0' ixz='0' iyy='2' iyz='0' izz='1.5'/></inertial>
<visual name='v' cast_shadows='false' laser_retro='100' transparency='0.25'>
<origin pose='0 0 0.5 0 0 0'/>
<geometry><cylinder radius='0.1' length='2'/></geometry>
<material script='Gazebo/Green'/>
</visual>
<visual name='w'><geometry><sphere radius='3'/></geometry><material script='Gazebo/Green'><ambient rgba='0 0.5 1 1'/></material></visual>
<collision name='c' laser_retro='100'>
<origin pose='0 0 0.5 0 0 0'/>
<max_contacts>250</max_contacts>
<geometry><box size='1 2 3'/></geometry>
<surface>
<friction><ode mu='0.5' mu2='0.2' fdir1='1 0 0' slip1='0.01' slip2='0.02'/></friction>
<bounce restitution_coefficient='0.5' threshold='0.1'/>
<contact><ode soft_cfm='0' soft_erp='0.2' kp='100000' kd='10' max_vel='100' min_depth='0.001'/></contact>
</surface>
</collision>
<sensor name='s' type='contact' always_on='true' update_rate='2'>
<origin pose='0 0 0.5 0 0 0'/>
<contact><collision name='c'/></contact>
<plugin name='p' filename='libgazebo_ros_bumper.so'><updateRate>100</updateRate></plugin>
</sensor>
</link>
<link name='b'><inertial mass='1'><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>
<joint name='j' type='revolute'>
<parent link='a'/><child link='b'/>
<origin pose='0 0 0.2 0 0 0'/>
<axis xyz='1 0 0'><limit lower='-1' upper='2' effort='3' velocity='4'/><dynamics damping='0.5' friction='0.25'/></axis>
<physics><ode><cfm>0.2</cfm><bounce>0</bounce><limit cfm='0' erp='0.1'/><suspension cfm='0' erp='0.2'/></ode></physics>
</joint>
<plugin name='p3d' filename='libgazebo_ros_p3d.so'><bodyName>a</bodyName></plugin>
</model>
<model name='ground' static='1'><link name='l'><collision name='c'><geometry><plane normal='0 0 1'/></geometry></collision></link></model>
<physics type='ode' update_rate='250'>
<gravity xyz='0 0 -9'/>
<max_contacts>15</max_contacts>
<ode>
<solver type='quick' dt='0.004' iters='70' sor='1.3'/>
<constraints cfm='0.01' erp='0.3' contact_max_correcting_vel='50' contact_surface_layer='0.002'/>
</ode>
</physics>
</world>
</gazebo>
)";

// The same, with each element in the same line.
const char* const kInElements = R"(<sdf version='1.6'>
<world name='w'>
<scene>
<ambient>0.1 0.2 0.3 1</ambient>
<background>0.4 0.5 0.6 1</background>
<shadows>false</shadows>
<fog><color>0 0 0.5 0.5</color><type>linear</type><start>2</start><end>10</end><density>0.5</density></fog>
</scene>
<light type='spot' name='lamp'><cast_shadows>false</cast_shadows>
<pose>0 0 8 0 0 0</pose>
<diffuse>1 0.5 0.5 1</diffuse>
<specular>0.1 0.1 0.1 1</specular>
<attenuation><range>20</range></attenuation>
<direction>0.5 0 -1</direction>
</light>
<model name='m'><static>false</static>
<pose>1 2 3 0.1 0.2 0.3</pose>
<link name='a'><gravity>false</gravity><self_collide>true</self_collide><kinematic>false</kinematic>
<pose>0 0 1 0 0 0</pose>
<inertial><mass>5</mass><pose>0 0 0.1 0 0 0</pose><inertia><ixx>1</ixx><ixy>0</ixy><ixz>0</ixz><iyy>2</iyy><iyz>0</iyz><izz>1.5</izz></inertia></inertial>
<visual name='v'><cast_shadows>false</cast_shadows><laser_retro>100</laser_retro><transparency>0.25</transparency>
<pose>0 0 0.5 0 0 0</pose>
<geometry><cylinder><radius>0.1</radius><length>2</length></cylinder></geometry>
<material><script><name>Gazebo/Green</name></script></material>
</visual>
<visual name='w'><geometry><sphere><radius>3</radius></sphere></geometry><material><script><name>Gazebo/Green</name></script><ambient>0 0.5 1 1</ambient></material></visual>
<collision name='c'><laser_retro>100</laser_retro>
<pose>0 0 0.5 0 0 0</pose>
<max_contacts>250</max_contacts>
<geometry><box><size>1 2 3</size></box></geometry>
<surface>
<friction><ode><mu>0.5</mu><mu2>0.2</mu2><fdir1>1 0 0</fdir1><slip1>0.01</slip1><slip2>0.02</slip2></ode></friction>
<bounce><restitution_coefficient>0.5</restitution_coefficient><threshold>0.1</threshold></bounce>
<contact><ode><soft_cfm>0</soft_cfm><soft_erp>0.2</soft_erp><kp>100000</kp><kd>10</kd><max_vel>100</max_vel><min_depth>0.001</min_depth></ode></contact>
</surface>
</collision>
<sensor name='s' type='contact'><always_on>true</always_on><update_rate>2</update_rate>
<pose>0 0 0.5 0 0 0</pose>
<contact><collision>c</collision></contact>
<plugin name='p' filename='libgazebo_ros_bumper.so'><updateRate>100</updateRate></plugin>
</sensor>
</link>
<link name='b'><inertial><mass>1</mass><inertia><ixx>1</ixx><ixy>0</ixy><ixz>0</ixz><iyy>1</iyy><iyz>0</iyz><izz>1</izz></inertia></inertial></link>
<joint name='j' type='revolute'>
<parent>a</parent><child>b</child>
<pose>0 0 0.2 0 0 0</pose>
<axis><xyz>1 0 0</xyz><use_parent_model_frame>1</use_parent_model_frame><limit><lower>-1</lower><upper>2</upper><effort>3</effort><velocity>4</velocity></limit><dynamics><damping>0.5</damping><friction>0.25</friction></dynamics></axis>
<physics><ode><cfm>0.2</cfm><bounce>0</bounce><limit><cfm>0</cfm><erp>0.1</erp></limit><suspension><cfm>0</cfm><erp>0.2</erp></suspension></ode></physics>
</joint>
<plugin name='p3d' filename='libgazebo_ros_p3d.so'><bodyName>a</bodyName></plugin>
</model>
<model name='ground'><static>1</static><link name='l'><collision name='c'><geometry><plane><normal>0 0 1</normal></plane></geometry></collision></link></model>
<physics type='ode'><max_step_size>0.004</max_step_size><real_time_update_rate>250</real_time_update_rate>

<max_contacts>15</max_contacts>
<ode>
<solver><type>quick</type><iters>70</iters><sor>1.3</sor></solver>
<constraints><cfm>0.01</cfm><erp>0.3</erp><contact_max_correcting_vel>50</contact_max_correcting_vel><contact_surface_layer>0.002</contact_surface_layer></constraints>
</ode>
</physics><gravity>0 0 -9</gravity>
</world>
</sdf>
)";

Element in_order(Element element) {
  for (Element& child : element.children) child = in_order(std::move(child));
  std::sort(element.children.begin(), element.children.end(),
            [](const Element& a, const Element& b) { return print_xml(a) < print_xml(b); });
  return element;
}

/// The settings in an order of their own, the models, and the places of all that is said of them.
std::string texts_of(const desc::World& world) {
  std::string all = print_xml(in_order(parse_xml(world.xml, "w.world")));
  for (const desc::Model& model : world.models) all += model.xml;
  for (const Diagnostic& each : world.warnings) all += each.text() + "\n";
  for (const Diagnostic& each : world.ignored) all += each.text() + "\n";
  return all;
}

TEST(Upgrade, AttributesOfSdf10AreElements) {
  for (const DefaultDialect default_dialect : {DefaultDialect::kGazebo, DefaultDialect::kOwn}) {
    SearchPaths paths;
    paths.default_dialect = default_dialect;
    const desc::World old = read(kInAttributes, paths);
    EXPECT_EQ(old.models.at(0).links[0].collisions[0].friction.mu, 0.5);
    EXPECT_EQ(texts_of(old), texts_of(read(kInElements, paths)));
  }
}

TEST(Upgrade, PartsOfSdf10HaveTheirNamesOfNow) {
  const std::map<std::string, std::string> kParts = {
      {"<mesh filename='a.dae' scale='1 2 3'/>",
       "<mesh><uri>a.dae</uri><scale>1 2 3</scale></mesh>"},
      {"<heightmap filename='a.png' size='9 9 1' origin='1 2 3'/>",
       "<heightmap><uri>a.png</uri><size>9 9 1</size><pos>1 2 3</pos></heightmap>"},
      {"<camera name='c'><horizontal_fov angle='1'/><image width='9' height='8'/></camera>",
       "<camera name='c'><horizontal_fov>1</horizontal_fov><image><width>9</width>"
       "<height>8</height></image></camera>"},
      {"<material><diffuse rgba='1 1 1 1'/><emissive rgba='0 0 0 1'/></material>",
       "<material><diffuse>1 1 1 1</diffuse><emissive>0 0 0 1</emissive></material>"},
      {"<grid enabled='0'/>", "<grid>0</grid>"},
      {"<state world_name='w' time='1 2'/>", "<state world_name='w'><time>1 2</time></state>"},
      {"<plugin name='p' filename='f'><a b='c'/></plugin>",
       "<plugin name='p' filename='f'><a b='c'/></plugin>"},
      {"<world name='w' angen:strict='true'/>", "<world name='w' angen:strict='true'/>"},
  };
  const SearchPaths paths;
  for (const auto& [old, now] : kParts) {
    Session session{paths};
    Element given = parse_xml(old, "f");
    upgrade(given, 100, session);
    Element wanted = parse_xml(now, "f");
    set_attribute(wanted, "version", "1.9");
    EXPECT_EQ(print_xml(given), print_xml(wanted));
  }
}

TEST(Upgrade, AMaterialOfSdf13IsNamedByTheTextOfItsScript) {
  const std::string sphere = "<geometry><sphere><radius>1</radius></sphere></geometry>";
  const desc::World world = read(in_link(
      "<visual name='v'>" + sphere + "<material><script>Gazebo/Red</script></material></visual>",
      "1.3"));
  const Eigen::Vector4f color = world.models.at(0).links[0].visuals[0].material.diffuse;
  EXPECT_GT(color.x(), 2.0F * color.y());
}

}  // namespace
}  // namespace angen::load
