"""The texture of a mesh's file in a camera's picture."""
from pathlib import Path

import numpy as np
from PIL import Image

import angen

WHITE = 77  # of sRGB: what 2.5 lx of ambient light make of white

DAE = '''<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema"
 version="1.4.1"><asset><unit name="m" meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_images><image id="i"><init_from>four%20colors.png</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON><newparam sid="s"><surface type="2D">
 <init_from>i</init_from></surface></newparam><newparam sid="t"><sampler2D><source>s</source>
 </sampler2D></newparam><technique sid="c"><lambert><diffuse><texture texture="t" texcoord="UV"/>
 </diffuse></lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
 <source id="p"><float_array id="pa" count="12">0 1 -1 0 -1 -1 0 -1 1 0 1 1</float_array>
 <technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/>
 <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
 <source id="u"><float_array id="ua" count="8">0 0 1 0 1 1 0 1</float_array><technique_common>
 <accessor source="#ua" count="4" stride="2"><param name="S" type="float"/>
 <param name="T" type="float"/></accessor></technique_common></source>
 <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
 <triangles count="2" material="mm"><input semantic="VERTEX" source="#v" offset="0"/>
 <input semantic="TEXCOORD" source="#u" offset="1" set="0"/><p>0 0 3 3 2 2 0 0 2 2 1 1</p>
 </triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g">
 <bind_material><technique_common><instance_material symbol="mm" target="#m">
 <bind_vertex_input semantic="UV" input_semantic="TEXCOORD" input_set="0"/></instance_material>
 </technique_common></bind_material></instance_geometry></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>'''


def test_a_mesh_has_the_texture_of_its_file(tmp_path: Path) -> None:
    """A picture, red and green above blue and white, 2 m ahead under ambient light alone."""
    colors = np.array([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 255]]], np.uint8)
    Image.fromarray(colors.repeat(64, axis=0).repeat(64, axis=1)).save(
        tmp_path / 'four colors.png')
    (tmp_path / 'sheet.dae').write_text(DAE)
    world = tmp_path / 'w.world'
    world.write_text('''<sdf version="1.6"><world name="w"><scene><ambient>1 1 1 1</ambient>
  <background>0 0 0 1</background></scene>
  <model name="sheet"><static>true</static><pose>2 0 0 0 0 0</pose><link name="l"><visual name="v">
    <geometry><mesh><uri>sheet.dae</uri></mesh></geometry></visual></link></model>
  <model name="eye"><static>true</static><link name="link"><sensor name="c" type="camera">
    <camera><horizontal_fov>1.4</horizontal_fov><image><width>64</width><height>64</height></image>
    <clip><near>0.05</near><far>20</far></clip></camera>
    <plugin name="p" filename="libgazebo_ros_camera.so"/></sensor></link></model>
</world></sdf>''')
    w = angen.World(str(world))
    w.request('camera', 'eye')
    w.step(1)
    places = w.sensor('camera', 'eye')['image'][[[16], [48]], [[16, 48]]].astype(int)
    expected = np.array([[[1, 0, 0], [0, 1, 0]], [[0, 0, 1], [1, 1, 1]]]) * places[1, 1, 0]
    assert abs(places[1, 1, 0] - WHITE) < 15
    np.testing.assert_allclose(places, expected, atol=4)
