// Its types are not checked: three has none of its own.
export const AdditiveBlending: any, NormalBlending: any, DoubleSide: any, PCFSoftShadowMap: any, SRGBColorSpace: any;
export const Box3: any, BoxGeometry: any, BufferAttribute: any, BufferGeometry: any, CapsuleGeometry: any, Color: any;
export const CylinderGeometry: any, DirectionalLight: any, Float32BufferAttribute: any, Fog: any, Group: any, HemisphereLight: any;
export const InstancedMesh: any, Matrix4: any, Mesh: any, MeshBasicMaterial: any, MeshLambertMaterial: any, Path: any;
export const PerspectiveCamera: any, Plane: any, Points: any, PointsMaterial: any, Quaternion: any, Raycaster: any, RingGeometry: any, Scene: any, ShaderMaterial: any, Shape: any;
export const ShapeGeometry: any, SphereGeometry: any, Vector2: any, Vector3: any, Vector4: any, WebGLRenderer: any;
