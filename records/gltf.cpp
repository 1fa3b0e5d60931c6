#include "records/gltf.hpp"

namespace lobelia::records {

void define_gltf_tables(Tables& tables) {
  tables.define<GltfAsset>("The format's version.");
  tables.define<GltfPerspective>("A perspective.");
  tables.define<GltfCameraExtras>("What glTF's camera cannot say.");
  tables.define<GltfCamera>("A camera.");
  tables.define<GltfAttributes>("Accessors of a mesh.", [](auto& t) {
    t.key("position").renamed("POSITION");
    t.key("normal").renamed("NORMAL");
  });
  tables.define<GltfPrimitive>("Triangles with a material.");
  tables.define<GltfMesh>("A mesh.");
  tables.define<GltfMetallicRoughness>("The base material.");
  tables.define<GltfSpecular>("KHR_materials_specular.");
  tables.define<GltfMaterialExtensions>("Extensions of a material.", [](auto& t) {
    t.key("specular").renamed("KHR_materials_specular");
  });
  tables.define<GltfMaterial>("A material; its extras are the exact one.");
  tables.define<GltfAccessor>("Numbers in a buffer.", [](auto& t) {
    t.keys({"min", "max"}).if_any();
  });
  tables.define<GltfBufferView>("Part of a buffer.");
  tables.define<GltfBuffer>("Bytes.");
  tables.define<GltfLight>("A light of KHR_lights_punctual.");
  tables.define<GltfLights>("The lights.");
  tables.define<GltfExtensions>("Extensions of the file.",
                                [](auto& t) { t.key("lights").renamed("KHR_lights_punctual"); });
  tables.define<GltfNodeLight>("The light of a node.");
  tables.define<GltfNodeExtensions>(
      "Extensions of a node.", [](auto& t) { t.key("lights").renamed("KHR_lights_punctual"); });
  tables.define<GltfNode>("A mesh, light or camera in its place.");
  tables.define<GltfScene>("The nodes to show.");
  tables.define<Gltf>("A scene.", [](auto& t) {
    // Empty lists are errors in glTF.
    t.keys({"extensionsUsed", "nodes", "cameras", "meshes", "materials", "accessors", "bufferViews",
            "buffers"})
        .if_any();
  });
}

}  // namespace lobelia::records
